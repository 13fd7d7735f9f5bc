plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    api(project(":dsl"))
    api(project(":spi"))
    testImplementation(project(":testkit"))
}
