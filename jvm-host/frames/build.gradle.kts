import org.collektive.gradle.FlatcJava
import org.collektive.gradle.GeneratorJava
import org.collektive.gradle.readsRepository

plugins {
    id("org.collektive.kotlin-module")
    id("org.collektive.flatbuffers")
}

val generatorPath = configurations.create("generatorPath") {
    isCanBeConsumed = false
}

dependencies {
    api(project(":flatbuffers"))
    api(project(":engine"))
    generatorPath(project(":generator"))
    testImplementation(project(":generator"))
    testImplementation(project(":runtime"))
    testImplementation(project(":stdlib"))
}

// Readers of frames; Vector3 and its like, to which generated code of users refers.
val readers = tasks.register<FlatcJava>("readers") {
    schemas.from("$rootDir/schema/frame.fbs", "$rootDir/schema/types.fbs")
}
val layouts = tasks.register<GeneratorJava>("layouts") {
    generator.from(generatorPath)
    schemas.from("$rootDir/schema/frame.fbs")
    product = "--layouts"
}

sourceSets.main {
    java.srcDir(readers)
    java.srcDir(layouts)
}

tasks.test {
    readsRepository("schema")
}
