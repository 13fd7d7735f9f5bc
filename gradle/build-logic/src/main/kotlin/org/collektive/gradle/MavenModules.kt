package org.collektive.gradle

import org.gradle.api.Plugin
import org.gradle.api.initialization.Settings

/** Includes each module of `jvm-host/pom.xml` as a project that follows its POM. */
public class MavenModules : Plugin<Settings> {
    override fun apply(settings: Settings) {
        val host = settings.rootDir.resolve("jvm-host")
        val reader = PomReader(settings.rootDir)
        val poms = reader.read(host).modules.associateWith { reader.read(host.resolve(it)) }
        for (module in poms.keys) {
            settings.include(module)
            settings.project(":$module").projectDir = host.resolve(module)
        }
        settings.gradle.beforeProject { project ->
            val pom = poms[project.name]
            if (pom != null) {
                MavenModule(project, pom).configure()
            } else {
                // build/ belongs to ./collektive.
                project.layout.buildDirectory.set(host.resolve("build"))
            }
        }
    }
}
