plugins {
    id("java-gradle-plugin")
    id("org.jetbrains.kotlin.jvm")
}

dependencies {
    implementation("org.apache.maven:maven-model-builder:3.9.11")
    // In the version of the plugin above.
    implementation("org.jetbrains.kotlin:kotlin-gradle-plugin")
}

kotlin {
    explicitApi()
    compilerOptions {
        allWarningsAsErrors = true
    }
}

gradlePlugin {
    plugins {
        register("maven-modules") {
            id = "org.collektive.maven-modules"
            implementationClass = "org.collektive.gradle.MavenModules"
        }
    }
}
