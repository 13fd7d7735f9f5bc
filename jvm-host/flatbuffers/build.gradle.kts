import org.collektive.gradle.flatbuffersSources

plugins {
    id("org.collektive.java-module")
    id("org.collektive.flatbuffers")
}

sourceSets.main {
    java.setSrcDirs(listOf(flatbuffersSources))
}

tasks.compileJava {
    dependsOn(tasks.requireSetup)
    options.isWarnings = false
    options.compilerArgs.add("-Xlint:none")
}
