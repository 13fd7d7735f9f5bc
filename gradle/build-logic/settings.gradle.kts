pluginManagement {
    repositories {
        mavenCentral()
        gradlePluginPortal()
    }
    val kotlin = file("../../jvm-host/pom.xml").readText().substringAfter("<kotlin.version>").substringBefore("<")
    plugins {
        id("org.jetbrains.kotlin.jvm") version kotlin
    }
}

dependencyResolutionManagement {
    repositories {
        mavenCentral()
    }
}

rootProject.name = "build-logic"
