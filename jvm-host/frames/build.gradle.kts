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
    testImplementation(libs.kotlin.compiler)
    testImplementation(project(":runtime"))
    testImplementation(project(":stdlib"))
}

// Readers of frames, with the object API; readers of Vector3 and its like, to which generated code of users refers.
val readers = tasks.register<FlatcJava>("readers") {
    schemas.from("$rootDir/schema/frame.fbs")
    objects = true
}
val types = tasks.register<FlatcJava>("types") {
    schemas.from("$rootDir/schema/types.fbs")
    objects = false
}
val layouts = tasks.register<GeneratorJava>("layouts") {
    generator.from(generatorPath)
    schemas.from("$rootDir/schema/frame.fbs")
    product = "--layouts"
}

sourceSets.main {
    java.srcDir(readers)
    java.srcDir(types)
    java.srcDir(layouts)
}

kotlin.sourceSets.named("test") {
    kotlin.srcDir("src/testFixtures/kotlin")
}

tasks.test {
    readsRepository("schema")
}
