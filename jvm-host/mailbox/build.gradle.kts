plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    api(project(":spi"))
    api(project(":runtime"))
}
