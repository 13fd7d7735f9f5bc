plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    api(project(":dsl"))
    kotlinCompilerPluginClasspathMain(libs.kotlin.serialization)
    testImplementation(project(":runtime"))
    testImplementation(libs.serialization.json)
}
