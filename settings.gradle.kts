// The same modules as jvm-host/pom.xml, which names all versions.
pluginManagement {
    repositories {
        mavenCentral()
        gradlePluginPortal()
    }
    val pom = rootDir.resolve("jvm-host/pom.xml").readText()
    val kotlinVersion = checkNotNull(Regex("<kotlin\\.version>(.+?)</").find(pom)).groupValues[1]
    plugins {
        id("org.jetbrains.kotlin.jvm") version kotlinVersion
    }
}

dependencyResolutionManagement {
    repositories {
        mavenCentral()
    }
}

rootProject.name = "collektive"

for (module in listOf("flatbuffers", "dsl", "runtime", "stdlib", "compiler-plugin", "api", "generator", "engine", "host", "programs", "bench")) {
    include(module)
    project(":$module").projectDir = file("jvm-host/$module")
}
