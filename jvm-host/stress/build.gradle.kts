plugins {
    id("org.collektive.kotlin-module")
}

dependencies {
    implementation(project(":runtime"))
    implementation(project(":engine"))
    implementation(libs.jcstress)
    annotationProcessor(libs.jcstress)
}

tasks.jar {
    archiveFileName = "collektive-stress.jar"
}
