plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    kotlinCompilerPluginClasspathTest(project(":compiler-plugin"))
    testImplementation(project(":stdlib"))
    testImplementation(project(":links"))
    testImplementation(project(":mailbox"))
    testImplementation(project(":testing"))
    testImplementation(project(":testkit"))
    testImplementation(libs.kotlin.metadata)
}
