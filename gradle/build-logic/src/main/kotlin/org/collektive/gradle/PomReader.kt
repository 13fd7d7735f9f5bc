package org.collektive.gradle

import org.apache.maven.model.ConfigurationContainer
import org.apache.maven.model.Model
import org.apache.maven.model.Plugin
import org.apache.maven.model.building.DefaultModelBuilderFactory
import org.apache.maven.model.building.DefaultModelBuildingRequest
import org.apache.maven.model.building.ModelBuildingRequest
import org.apache.maven.model.io.xpp3.MavenXpp3Reader
import org.apache.maven.model.io.xpp3.MavenXpp3Writer
import org.codehaus.plexus.util.xml.Xpp3Dom
import java.io.File
import java.io.StringReader
import java.io.StringWriter

/** Reads effective POMs, with everything inherited and interpolated as Maven does it. */
internal class PomReader(private val root: File) {
    /** Returns the POM of [module], in which `build` replaces Maven's output directory `target`. */
    fun read(module: File): Model {
        val request = DefaultModelBuildingRequest()
            .setPomFile(module.resolve("pom.xml"))
            .setProcessPlugins(true)
            .setValidationLevel(ModelBuildingRequest.VALIDATION_LEVEL_MINIMAL)
            .setSystemProperties(mapOf("java.home" to System.getProperty("java.home")).toProperties())
            .setUserProperties(mapOf("maven.multiModuleProjectDirectory" to root.path).toProperties())
        val text = StringWriter()
        MavenXpp3Writer().write(text, DefaultModelBuilderFactory().newInstance().build(request).effectiveModel)
        return MavenXpp3Reader().read(StringReader(text.toString().replace(MAVEN_OUTPUT, "$1build")))
    }

    private companion object {
        val MAVEN_OUTPUT = Regex("""([/\\])target\b""")
    }
}

/** Returns the plugin [name]. Maven itself adds some plugins; of these, a module may have only an entry in the plugin management. */
internal fun Model.plugin(name: String): Plugin = (build.plugins + build.pluginManagement.plugins).first { it.artifactId == name }

/** The configuration of a plugin or of one of its executions. */
internal val ConfigurationContainer.settings: Xpp3Dom get() = configuration as? Xpp3Dom ?: Xpp3Dom("configuration")

internal fun Xpp3Dom.text(name: String): String? = getChild(name)?.value

internal fun Xpp3Dom.children(name: String): List<Xpp3Dom> = getChild(name)?.children.orEmpty().toList()

internal fun Xpp3Dom.texts(name: String): List<String> = children(name).map { it.value.orEmpty() }
