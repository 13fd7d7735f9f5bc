plugins {
    id("org.collektive.kotlin-module")
}

val lifterPath = configurations.create("lifterPath") {
    isCanBeConsumed = false
}

dependencies {
    api(project(":dsl"))
    lifterPath(project(":lifter"))
}

val lift = tasks.register<JavaExec>("lift") {
    val sources = layout.buildDirectory.dir("generated/lifter")
    classpath = lifterPath
    mainClass = "org.collektive.lifter.MainKt"
    args(sources.get().asFile)
    outputs.dir(sources)
}

kotlin.sourceSets.named("main") {
    kotlin.srcDir(lift)
}
