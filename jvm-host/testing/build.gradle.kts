plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    // Tests have both in the jars of the package.
    api(project(":frames"))
    api(project(":dsl"))
    kotlinCompilerPluginClasspathTest(project(":compiler-plugin"))
    testImplementation(project(":stdlib"))
    testImplementation(project(":links"))
    testImplementation(project(":mailbox"))
}

tasks.jar {
    archiveFileName = "collektive-testing.jar"
}
