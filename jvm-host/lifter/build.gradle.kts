plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    implementation(libs.kotlin.reflect)
}
