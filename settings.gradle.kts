// The modules of jvm-host for those who live in Gradle or IntelliJ; CI and ./collektive use jvm-host/pom.xml.
pluginManagement {
    includeBuild("gradle/build-logic")
    repositories {
        mavenCentral()
        gradlePluginPortal()
    }
}

dependencyResolutionManagement {
    repositories {
        mavenCentral()
    }
}

rootProject.name = "collektive"

val modules = listOf(
    "flatbuffers",
    "spi",
    "dsl",
    "testkit",
    "runtime",
    "mailbox",
    "compiler-plugin",
    "lifter",
    "fielded",
    "stdlib",
    "api",
    "links",
    "engine",
    "generator",
    "frames",
    "testing",
    "host",
    "tools",
    "programs",
    "bench",
    "stress",
    "conformance",
    "architecture",
)
for (module in modules) {
    include(module)
    project(":$module").projectDir = file("jvm-host/$module")
}
