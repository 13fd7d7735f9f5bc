// What the modules of jvm-host share: their conventions, and the tasks that make code of schemas.
plugins {
    id("java-gradle-plugin")
    alias(libs.plugins.kotlin.jvm)
}

dependencies {
    implementation(libs.kotlin.gradle)
    implementation(libs.shadow.gradle)
}

kotlin {
    explicitApi()
    compilerOptions {
        allWarningsAsErrors = true
    }
}

gradlePlugin {
    plugins {
        register("java-module") {
            id = "org.collektive.java-module"
            implementationClass = "org.collektive.gradle.JavaModule"
        }
        register("kotlin-module") {
            id = "org.collektive.kotlin-module"
            implementationClass = "org.collektive.gradle.KotlinModule"
        }
        register("flatbuffers") {
            id = "org.collektive.flatbuffers"
            implementationClass = "org.collektive.gradle.FlatBuffers"
        }
        register("host-jars") {
            id = "org.collektive.host-jars"
            implementationClass = "org.collektive.gradle.HostJars"
        }
        register("standalone-jar") {
            id = "org.collektive.standalone-jar"
            implementationClass = "org.collektive.gradle.StandaloneJar"
        }
    }
}
