package org.collektive.gradle

import org.apache.maven.model.Model
import org.codehaus.plexus.util.xml.Xpp3Dom
import org.gradle.api.Project
import org.gradle.api.artifacts.component.ComponentIdentifier
import org.gradle.api.artifacts.component.ModuleComponentIdentifier
import org.gradle.api.artifacts.component.ProjectComponentIdentifier
import org.gradle.api.file.ArchiveOperations
import org.gradle.api.file.DuplicatesStrategy
import org.gradle.api.file.FileCollection
import org.gradle.api.plugins.BasePluginExtension
import org.gradle.api.tasks.bundling.AbstractArchiveTask
import org.gradle.api.tasks.bundling.Jar
import java.io.File
import javax.inject.Inject

/** Builds the same jars as Maven, with the same names and places. */
internal fun configureJars(project: Project, pom: Model, classes: FileCollection) {
    project.extensions.getByType(BasePluginExtension::class.java).libsDirectory.set(project.layout.buildDirectory)
    project.tasks.withType(AbstractArchiveTask::class.java).configureEach {
        it.isPreserveFileTimestamps = false
        it.isReproducibleFileOrder = true
    }
    project.tasks.named("jar", Jar::class.java) { it.archiveFileName.set("${pom.build.finalName}.jar") }
    for (execution in pom.plugin("maven-shade-plugin").executions) shade(project, pom, classes, execution.settings)
}

/** Makes a jar of [classes] and of those dependencies that the artifact set of [settings] contains. */
private fun shade(project: Project, pom: Model, classes: FileCollection, settings: Xpp3Dom) {
    val output = File(checkNotNull(settings.text("outputFile")))
    val artifacts = settings.getChild("artifactSet") ?: Xpp3Dom("artifactSet")
    val dependencies = project.configurations.getByName("runtimeClasspath").incoming.artifactView { view ->
        view.componentFilter { component ->
            val included = artifacts.texts("includes").ifEmpty { listOf("*") }
            included.any { component.matches(it, pom) } && artifacts.texts("excludes").none { component.matches(it, pom) }
        }
    }
    val (everywhere, own) = settings.children("filters").partition { it.text("artifact") == "*:*" }
    val jar = project.tasks.register(output.nameWithoutExtension, ShadedJar::class.java) { jar ->
        jar.archiveFileName.set(output.name)
        jar.duplicatesStrategy = DuplicatesStrategy.EXCLUDE
        jar.from(classes) { spec -> spec.exclude(own.flatMap { it.texts("excludes") }) }
        jar.contents(dependencies.files)
        // Maven's plugin never includes a module-info.class.
        jar.exclude(everywhere.flatMap { it.texts("excludes") } + "module-info.class")
        val main = settings.children("transformers").firstNotNullOfOrNull { it.text("mainClass") }
        if (main != null) jar.manifest.attributes(mapOf("Main-Class" to main))
    }
    project.tasks.named("assemble") { it.dependsOn(jar) }
}

/** A jar that contains other jars' entries. */
internal abstract class ShadedJar : Jar() {
    @get:Inject
    protected abstract val archives: ArchiveOperations

    /** Adds the entries of [jars]. */
    fun contents(jars: FileCollection) {
        val archives = archives
        from(jars.elements.map { files -> files.map { archives.zipTree(it) } })
    }
}

/** Whether [pattern] (`group:artifact`, with `*` for any text) matches. */
private fun ComponentIdentifier.matches(pattern: String, pom: Model): Boolean {
    val name = when (this) {
        is ProjectComponentIdentifier -> "${pom.groupId}:$projectName"
        is ModuleComponentIdentifier -> "$group:$module"
        else -> displayName
    }
    return Regex(pattern.split('*').joinToString(".*", transform = Regex::escape)).matches(name)
}
