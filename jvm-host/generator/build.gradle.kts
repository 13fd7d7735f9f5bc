import org.collektive.gradle.readsRepository

plugins {
    id("org.collektive.kotlin-module")
    id("org.collektive.standalone-jar")
}

dependencies {
    implementation(project(":flatbuffers"))
    implementation(libs.jmustache)
}

tasks.processResources {
    from("$rootDir/schema/templates") {
        into("org/collektive/generator")
    }
}

tasks.shadowJar {
    manifest.attributes("Main-Class" to "org.collektive.generator.MainKt")
}

tasks.test {
    readsRepository("schema", "unity/Samples~", "unity/Runtime/Bridge/Generated")
}
