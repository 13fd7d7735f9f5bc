plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    // Both run from their own jars, as in Unity.
    compileOnly(project(":host"))
    compileOnly(project(":programs"))
    implementation(libs.jmh.core)
    annotationProcessor(libs.jmh.processor)
    kotlinCompilerPluginClasspathMain(project(":compiler-plugin"))
    testImplementation(project(":host"))
    testImplementation(project(":programs"))
}

tasks.jar {
    archiveFileName = "collektive-bench.jar"
}
