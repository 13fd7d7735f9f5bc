// Builds the modules of jvm-host for those who live in Gradle or IntelliJ; CI and ./collektive use jvm-host/pom.xml.
// FlatBuffers (flatc and the Java runtime) comes from `./collektive setup`.
import org.jetbrains.kotlin.gradle.dsl.JvmTarget
import org.jetbrains.kotlin.gradle.dsl.KotlinJvmProjectExtension

plugins {
    id("org.jetbrains.kotlin.jvm") apply false
}

/** The simple elements of a POM; of several with one name the first, which is the project's own. */
fun pomValues(pom: String): Map<String, String> =
    Regex("<([a-z.-]+)>([^<]+)</\\1>").findAll(file(pom).readText()).toList().asReversed().associate { it.groupValues[1] to it.groupValues[2] }

val parent = pomValues("jvm-host/pom.xml")
val release = parent.getValue("java.release").toInt()
val kotlinVersion = parent.getValue("kotlin.version")
val flatc = file("build/flatc")
val flatbuffersSources = file("build/flatbuffers/java/src/main/java")

fun requireSetup() {
    if (!flatc.exists() || !flatbuffersSources.exists()) throw GradleException("FlatBuffers is missing: run ./collektive setup")
}

/** Makes [name] a step that fills [folder] with Java sources of this module. */
fun Project.generatedJava(name: String, folder: Provider<Directory>, inputs: Any, configure: Exec.() -> Unit) {
    val task = tasks.register<Exec>(name) {
        this.inputs.files(inputs)
        outputs.dir(folder)
        doFirst { requireSetup() }
        configure()
    }
    extensions.getByType<SourceSetContainer>()["main"].java.srcDir(folder)
    for (user in listOf("compileKotlin", "compileJava", "processResources")) tasks.named(user) { dependsOn(task) }
}

subprojects {
    apply(plugin = "java-library")
    apply(plugin = "org.jetbrains.kotlin.jvm")
    group = "org.collektive"
    version = parent.getValue("version")
    // Beside Maven's output, out of git's sight.
    layout.buildDirectory.set(file("target/gradle"))

    extensions.configure<KotlinJvmProjectExtension> {
        explicitApi()
        compilerOptions {
            jvmTarget.set(JvmTarget.fromTarget("$release"))
            freeCompilerArgs.add("-Xjdk-release=$release")
            allWarningsAsErrors.set(true)
        }
    }
    tasks.withType<JavaCompile>().configureEach {
        options.release.set(release)
        options.compilerArgs.add("-Xlint:none")
    }
    tasks.withType<Test>().configureEach {
        useJUnitPlatform()
        maxHeapSize = "384m"
        systemProperty("collektive.root", rootDir.path)
        systemProperty("collektive.flatc", flatc.path)
    }
    dependencies {
        "implementation"("org.jetbrains.kotlin:kotlin-stdlib:$kotlinVersion")
        "testImplementation"("org.jetbrains.kotlin:kotlin-test-junit5:$kotlinVersion")
        "testImplementation"(platform("org.junit:junit-bom:${parent.getValue("junit.version")}"))
        "testImplementation"("org.junit.jupiter:junit-jupiter")
        "testRuntimeOnly"("org.junit.platform:junit-platform-launcher")
    }
}

project(":flatbuffers") {
    extensions.getByType<SourceSetContainer>()["main"].java.srcDir(flatbuffersSources)
    tasks.named("compileJava") { doFirst { requireSetup() } }
}

val serialization = "org.jetbrains.kotlinx:kotlinx-serialization-%s-jvm:${parent.getValue("serialization.version")}"
for (name in listOf(":dsl", ":stdlib")) {
    project(name) {
        dependencies {
            "kotlinCompilerPluginClasspath"("org.jetbrains.kotlin:kotlin-serialization-compiler-plugin-embeddable:$kotlinVersion")
        }
    }
}

project(":dsl") {
    dependencies { "api"(serialization.format("core")) }
}

project(":runtime") {
    dependencies {
        "api"(project(":dsl"))
        "testImplementation"(serialization.format("json"))
    }
}

project(":stdlib") {
    dependencies {
        "api"(project(":dsl"))
        "testImplementation"(project(":runtime"))
        "testImplementation"(serialization.format("json"))
    }
}

project(":api") {
    dependencies {
        "api"(project(":flatbuffers"))
        "api"(project(":dsl"))
    }
    val folder = layout.buildDirectory.dir("generated/flatbuffers")
    generatedJava("coreTypes", folder, file("$rootDir/schema/types.fbs")) {
        commandLine(flatc.path, "--java", "--gen-object-api", "-o", folder.get().asFile.path, "$rootDir/schema/types.fbs")
    }
}

project(":compiler-plugin") {
    dependencies {
        // The compiler that loads the plugin brings it.
        "compileOnly"("org.jetbrains.kotlin:kotlin-compiler-embeddable:$kotlinVersion")
        "testImplementation"("org.jetbrains.kotlin:kotlin-compiler-embeddable:$kotlinVersion")
        "testImplementation"("org.jetbrains.kotlin:kotlin-serialization-compiler-plugin-embeddable:$kotlinVersion")
        "testImplementation"(serialization.format("json"))
        "testImplementation"(project(":runtime"))
        "testImplementation"(project(":stdlib"))
    }
    // The tests run the Kotlin compiler in their process.
    tasks.withType<Test>().configureEach { maxHeapSize = "640m" }
}

project(":generator") {
    dependencies {
        "implementation"(project(":flatbuffers"))
        "implementation"("com.samskivert:jmustache:${pomValues("jvm-host/generator/pom.xml").getValue("jmustache.version")}")
        "testImplementation"(project(":api"))
    }
    tasks.named<ProcessResources>("processResources") {
        from("$rootDir/schema/templates") { into("org/collektive/generator") }
    }
}

project(":engine") {
    dependencies {
        "api"(project(":api"))
        "api"(project(":runtime"))
    }
}

project(":host") {
    dependencies {
        "api"(project(":engine"))
        "api"(project(":stdlib"))
        "implementation"("org.slf4j:slf4j-jdk14:${parent.getValue("slf4j.version")}")
        "testImplementation"(project(":generator"))
        "testImplementation"("org.jetbrains.kotlin:abi-tools:$kotlinVersion")
        "testImplementation"("org.jetbrains.kotlin:kotlin-metadata-jvm:$kotlinVersion")
    }
    val folder = layout.buildDirectory.dir("generated/flatbuffers")
    generatedJava("frames", folder, file("$rootDir/schema/frame.fbs")) {
        commandLine(flatc.path, "--java", "--gen-object-api", "-o", folder.get().asFile.path, "$rootDir/schema/frame.fbs")
    }
    // One jar: the JVM's class path in Unity, and the compile class path of programs.
    val classes = extensions.getByType<SourceSetContainer>()["main"].output
    val libraries = configurations["runtimeClasspath"]
    val hostJar = tasks.register<Jar>("hostJar") {
        archiveFileName.set("collektive-host.jar")
        destinationDirectory.set(file("target"))
        duplicatesStrategy = DuplicatesStrategy.EXCLUDE
        from(classes)
        dependsOn(libraries)
        from({ libraries.map { if (it.isDirectory) it else zipTree(it) } })
        exclude("META-INF/MANIFEST.MF", "META-INF/versions/**", "META-INF/maven/**")
    }
    tasks.named("assemble") { dependsOn(hostJar) }
}

project(":bench") {
    val jmh = parent.getValue("jmh.version")
    dependencies {
        "compileOnly"(project(":host"))
        "compileOnly"(project(":programs"))
        "implementation"("org.openjdk.jmh:jmh-core:$jmh")
        "annotationProcessor"("org.openjdk.jmh:jmh-generator-annprocess:$jmh")
        "kotlinCompilerPluginClasspath"(project(":compiler-plugin"))
        "testImplementation"(project(":host"))
    }
    tasks.named<Jar>("jar") {
        archiveFileName.set("collektive-bench.jar")
        destinationDirectory.set(file("target"))
    }
}

project(":programs") {
    val generator = configurations.create("generator")
    dependencies {
        "compileOnly"(project(":host"))
        "kotlinCompilerPluginClasspath"(project(":compiler-plugin"))
        "testImplementation"(project(":host"))
        "generator"(project(":generator"))
    }
    for (schema in fileTree("$rootDir/unity/Samples~") { include("*/*.fbs") }.files.sorted()) {
        val folder = layout.buildDirectory.dir("generated/${schema.nameWithoutExtension}")
        generatedJava(schema.nameWithoutExtension, folder, files(schema, generator)) {
            doFirst {
                commandLine(
                    "${System.getProperty("java.home")}/bin/java", "-cp", generator.asPath, "org.collektive.generator.MainKt",
                    "--flatc", flatc.path, "--schema", schema.path, "--include", "$rootDir/schema", "--java", folder.get().asFile.path,
                )
            }
        }
    }
    tasks.named<Jar>("jar") {
        archiveFileName.set("collektive-programs.jar")
        destinationDirectory.set(file("target"))
    }
}
