import org.collektive.gradle.readsRepository

plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    // Both run from their own jars: the tools find the host's classes in the host's jar.
    compileOnly(project(":host"))
    // The tests generate and compile a user's jar.
    testImplementation(project(":host"))
    testImplementation(project(":generator"))
    testImplementation(libs.kotlin.compiler)
}

kotlin.sourceSets.named("test") {
    kotlin.srcDir("../host/src/testFixtures/kotlin")
    kotlin.srcDir("../frames/src/testFixtures/kotlin")
}

tasks.jar {
    archiveFileName = "collektive-tools.jar"
}

tasks.test {
    readsRepository("schema", "jvm-host/host/src/test")
}
