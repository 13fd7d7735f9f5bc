plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    api(project(":api"))
    api(project(":spi"))
    testImplementation(project(":runtime"))
    testImplementation(project(":mailbox"))
    testImplementation(project(":testkit"))
}
