plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    api(libs.serialization.core)
    kotlinCompilerPluginClasspathMain(libs.kotlin.serialization)
    testImplementation(libs.serialization.json)
}
