package org.collektive.gradle

import com.github.jengelman.gradle.plugins.shadow.internal.DependencyFilter
import com.github.jengelman.gradle.plugins.shadow.tasks.ShadowJar
import org.gradle.api.Plugin
import org.gradle.api.Project

/** Makes `collektive-host.jar` and the two libraries beside it, which sessions load, as Maven shades them. */
public class HostJars : Plugin<Project> {
    override fun apply(project: Project) {
        project.pluginManager.apply(StandaloneJar::class.java)
        project.tasks.named("shadowJar", ShadowJar::class.java) { jar ->
            jar.dependencies { filter ->
                for (name in LIBRARY_MODULES + ADAPTER_MODULE) filter.exclude(filter.project(":$name"))
                for (group in LIBRARY_GROUPS) filter.exclude(filter.dependency("$group:.*"))
            }
        }
        jar(project, "library") { filter ->
            for (name in LIBRARY_MODULES) filter.include(filter.project(":$name"))
            for (group in LIBRARY_GROUPS) filter.include(filter.dependency("$group:.*"))
        }
        jar(project, "adapter") { filter -> filter.include(filter.project(":$ADAPTER_MODULE")) }
    }

    /** A jar of those of the module's dependencies that [choose] includes, and nothing of the module itself. */
    private fun jar(project: Project, name: String, choose: (DependencyFilter) -> Unit) {
        val jar = project.tasks.register("${name}Jar", ShadowJar::class.java) {
            it.archiveFileName.set("collektive-$name.jar")
            it.destinationDirectory.set(project.layout.buildDirectory.dir("libs"))
            it.configurations = listOf(project.configurations.getByName("runtimeClasspath"))
            it.dependencies(choose)
            it.mergeServiceFiles()
            it.exclude("META-INF/versions/**", "META-INF/maven/**")
        }
        project.tasks.named("assemble") { it.dependsOn(jar) }
    }

    private companion object {
        val LIBRARY_MODULES = listOf("dsl", "runtime", "links", "stdlib", "fielded")
        val LIBRARY_GROUPS = listOf("org.jetbrains.kotlinx", "io.arrow-kt")
        const val ADAPTER_MODULE = "mailbox"
    }
}
