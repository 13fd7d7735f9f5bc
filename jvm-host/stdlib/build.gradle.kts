plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    api(project(":dsl"))
    api(project(":fielded"))
    api(libs.arrow.core)
    kotlinCompilerPluginClasspathMain(libs.kotlin.serialization)
    testImplementation(project(":runtime"))
    // The tests compare the lifted operators with Kotlin's own functions.
    testImplementation(libs.kotlin.reflect)
    testImplementation(project(":testkit"))
}

tasks.test {
    // Reflection on all of Kotlin's functions on arrays.
    maxHeapSize = "1g"
}
