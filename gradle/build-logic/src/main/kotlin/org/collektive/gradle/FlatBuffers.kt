package org.collektive.gradle

import org.gradle.api.Plugin
import org.gradle.api.Project
import java.io.File

/** Gives a module FlatBuffers as `./collektive setup` leaves it in `build/`, and its tasks what they read of that. */
public class FlatBuffers : Plugin<Project> {
    override fun apply(project: Project) {
        val setup = project.tasks.register("requireSetup", RequireSetup::class.java) {
            it.files.from(project.flatc, project.flatbuffersSources)
        }
        project.tasks.withType(SchemaTask::class.java).configureEach {
            it.dependsOn(setup)
            it.flatc.set(project.flatc)
            it.output.convention(project.layout.buildDirectory.dir("generated/${it.name}"))
        }
        project.tasks.withType(GeneratorJava::class.java).configureEach { it.coreTypes.set(project.rootDir.resolve("schema/types.fbs")) }
    }
}

/** FlatBuffers' Java runtime. */
public val Project.flatbuffersSources: File get() = rootDir.resolve("build/flatbuffers/java/src/main/java")

/** The compiler of schemas. */
internal val Project.flatc: File get() = rootDir.resolve("build/flatc")
