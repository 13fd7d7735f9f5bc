// Lets IntelliJ IDEA and VS Code complete and check the Kotlin, and runs its tests with Gradle. Collektive for Unity does not need this file.
plugins {
    kotlin("jvm") version "2.4.21"
}

// Files of Collektive for Unity on this computer.
val library = files("@HOST@", "@LIBRARY@")
val testing = files("@TESTING@")
val plugin = files("@PLUGIN@")
val generator = files("@GENERATOR@")
val flatc = "@FLATC@"
val types = "@TYPES@"

val schemas = files("@SCHEMAS@")
val programs = files("@PROGRAMS@")

repositories {
    mavenCentral()
}

dependencies {
    implementation(library)
    kotlinCompilerPluginClasspath(plugin)
    testImplementation(testing)
    testImplementation(kotlin("test-junit5"))
    testRuntimeOnly("org.junit.platform:junit-platform-launcher")
}

val generated = layout.buildDirectory.dir("generated/schemas")

// Writes the classes of the schemas, such as SensorData.
val generateSchemas by tasks.registering(JavaExec::class) {
    inputs.files(schemas, generator)
    outputs.dir(generated)
    classpath = generator
    args("--flatc", flatc, "--include", types, "--jvm", generated.get().asFile)
    schemas.forEach { args("--schema", it) }
    // A renamed schema leaves the classes of its old name.
    doFirst { outputs.files.forEach { it.deleteRecursively() } }
}

// Inline functions of the library cannot be compiled for an older JVM.
kotlin.compilerOptions.jvmTarget.set(org.jetbrains.kotlin.gradle.dsl.JvmTarget.JVM_17)
tasks.withType<JavaCompile>().configureEach {
    options.release.set(17)
}

sourceSets["main"].java.setSrcDirs(listOf(generateSchemas))
kotlin.sourceSets["main"].kotlin.setSrcDirs(listOf(programs, generateSchemas))
kotlin.sourceSets["test"].kotlin.setSrcDirs(listOf("tests"))

tasks.test {
    useJUnitPlatform()
}
