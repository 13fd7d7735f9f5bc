import org.collektive.gradle.GeneratorJava

plugins {
    id("org.collektive.kotlin-module")
    id("org.collektive.flatbuffers")
}

val generatorPath = configurations.create("generatorPath") {
    isCanBeConsumed = false
}

dependencies {
    compileOnly(project(":host"))
    generatorPath(project(":generator"))
    kotlinCompilerPluginClasspathMain(project(":compiler-plugin"))
    testImplementation(project(":host"))
    testImplementation(project(":testing"))
    testImplementation(project(":testkit"))
}

val schemaCode = tasks.register<GeneratorJava>("schemaCode") {
    generator.from(generatorPath)
    schemas.from(fileTree("$rootDir/unity/Samples~") { include("*/*.fbs") })
    product = "--jvm"
}

sourceSets.main {
    java.srcDir(schemaCode)
}
kotlin.sourceSets.named("main") {
    kotlin.srcDir(schemaCode)
}

// By which the host finds the schemas, and tools read their data.
tasks.processResources {
    from(schemaCode) {
        include("META-INF/**")
    }
}

tasks.jar {
    archiveFileName = "collektive-programs.jar"
}
