plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    api(project(":dsl"))
    api(libs.arrow.core)
    kotlinCompilerPluginClasspathMain(libs.kotlin.serialization)
    testImplementation(project(":runtime"))
    testImplementation(libs.serialization.json)
}
