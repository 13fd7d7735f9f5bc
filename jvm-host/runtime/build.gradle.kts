plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    api(project(":dsl"))
    api(project(":spi"))
    testImplementation(libs.serialization.json)
}
