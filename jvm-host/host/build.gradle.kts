import org.collektive.gradle.readsRepository

plugins {
    id("org.collektive.kotlin-module")
    id("org.collektive.host-jars")
}

dependencies {
    api(project(":frames"))
    api(project(":runtime"))
    // Not used by the host: sessions load these from jars beside the host's.
    api(project(":mailbox"))
    api(project(":links"))
    api(project(":stdlib"))
    // Programs that log with slf4j find it here, bound to java.util.logging.
    implementation(libs.slf4j)
    // The tests generate and compile a user's jar, and dump what programs see of the modules.
    testImplementation(project(":generator"))
    testImplementation(project(":testing"))
    // Before kotlin-abi, which contains parts of it.
    testImplementation(libs.kotlin.compiler)
    testImplementation(libs.kotlin.abi)
    testImplementation(libs.kotlin.metadata)
}

kotlin.sourceSets.named("test") {
    kotlin.srcDir("src/testFixtures/kotlin")
    kotlin.srcDir("../frames/src/testFixtures/kotlin")
}

tasks.test {
    readsRepository(
        "schema",
        "jvm-host/host/src/test",
        "jvm-host/api/api",
        "jvm-host/dsl/api",
        "jvm-host/frames/api",
        "jvm-host/runtime/api",
        "jvm-host/stdlib/api",
        "jvm-host/testing/api",
    )
}
