package org.collektive.gradle

import org.apache.maven.model.ConfigurationContainer
import org.apache.maven.model.Model
import org.apache.maven.model.Plugin
import org.apache.maven.model.PluginExecution
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
        val builder = DefaultModelBuilderFactory().newInstance().setLifecycleBindingsInjector { model, _, _ -> bindPlugins(model) }
        val text = StringWriter()
        MavenXpp3Writer().write(text, builder.build(request).effectiveModel)
        return MavenXpp3Reader().read(StringReader(text.toString().replace(MAVEN_OUTPUT, "$1build")))
    }

    /** Adds the plugins that Maven binds to the lifecycle of each module, for their managed configuration. */
    private fun bindPlugins(model: Model) = LIFECYCLE_PLUGINS.filter { model.plugin(it) == null }.forEach { name ->
        model.build.addPlugin(Plugin().apply { artifactId = name })
    }

    private companion object {
        val LIFECYCLE_PLUGINS = listOf("maven-compiler-plugin", "maven-jar-plugin", "maven-surefire-plugin")
        val MAVEN_OUTPUT = Regex("""([/\\])target\b""")
    }
}

internal fun Model.plugin(name: String): Plugin? = build.plugins.find { it.artifactId == name }

internal fun Model.executions(plugin: String): List<PluginExecution> = plugin(plugin)?.executions.orEmpty()

internal fun Model.settings(plugin: String): Xpp3Dom = plugin(plugin)?.settings ?: Xpp3Dom("configuration")

/** The configuration of a plugin or of one of its executions. */
internal val ConfigurationContainer.settings: Xpp3Dom get() = configuration as? Xpp3Dom ?: Xpp3Dom("configuration")

internal fun Xpp3Dom.text(name: String): String? = getChild(name)?.value

internal fun Xpp3Dom.children(name: String): List<Xpp3Dom> = getChild(name)?.children.orEmpty().toList()

internal fun Xpp3Dom.texts(name: String): List<String> = children(name).map { it.value.orEmpty() }
