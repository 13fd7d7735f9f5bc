plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    // The compiler that loads the plugin brings it.
    compileOnly(libs.kotlin.compiler)
    testImplementation(libs.kotlin.compiler)
    testImplementation(libs.kotlin.serialization)
    testImplementation(project(":stdlib"))
    testImplementation(project(":runtime"))
    testImplementation(project(":api"))
    testImplementation(project(":testkit"))
}

tasks.test {
    // The tests run the Kotlin compiler in their process.
    maxHeapSize = "640m"
    jvmArgs("-XX:+UseSerialGC", "-XX:TieredStopAtLevel=1")
}
