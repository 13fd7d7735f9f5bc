package org.collektive.gradle

import com.github.jengelman.gradle.plugins.shadow.tasks.ShadowJar
import org.gradle.api.Plugin
import org.gradle.api.Project

/** Makes `collektive-MODULE.jar`: the module and all that it needs at run time in one jar, as Maven shades it. */
public class StandaloneJar : Plugin<Project> {
    override fun apply(project: Project) {
        project.pluginManager.apply("com.gradleup.shadow")
        val name = "collektive-${project.name}.jar"
        val shadowJar = project.tasks.named("shadowJar", ShadowJar::class.java) {
            it.archiveFileName.set(name)
            it.mergeServiceFiles()
            it.exclude("META-INF/versions/**", "META-INF/maven/**")
        }
        project.tasks.named("assemble") { it.dependsOn(shadowJar) }
    }
}
