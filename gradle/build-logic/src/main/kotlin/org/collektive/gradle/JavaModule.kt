package org.collektive.gradle

import org.gradle.api.Plugin
import org.gradle.api.Project
import org.gradle.api.artifacts.VersionCatalog
import org.gradle.api.artifacts.VersionCatalogsExtension
import org.gradle.api.tasks.bundling.AbstractArchiveTask
import org.gradle.api.tasks.compile.JavaCompile

/** A module for the Java release that `java` names in the version catalog, with jars that repeat. */
public class JavaModule : Plugin<Project> {
    override fun apply(project: Project) {
        project.pluginManager.apply("java-library")
        val release = project.javaRelease
        project.tasks.withType(JavaCompile::class.java).configureEach { it.options.release.set(release) }
        project.tasks.withType(AbstractArchiveTask::class.java).configureEach {
            it.isPreserveFileTimestamps = false
            it.isReproducibleFileOrder = true
        }
    }
}

internal val Project.libs: VersionCatalog get() = extensions.getByType(VersionCatalogsExtension::class.java).named("libs")

internal val Project.javaRelease: Int get() = libs.findVersion("java").get().requiredVersion.toInt()
