// Builds jvm-host with Gradle, for its users and IntelliJ. The modules are described in jvm-host/pom.xml and jvm-host/*/pom.xml.
pluginManagement {
    includeBuild("gradle/build-logic")
    repositories {
        mavenCentral()
        gradlePluginPortal()
    }
}

plugins {
    id("org.collektive.maven-modules")
}

dependencyResolutionManagement {
    repositories {
        mavenCentral()
    }
}

rootProject.name = "collektive"
