package org.collektive.architecture

import java.util.Properties
import kotlin.test.Test
import kotlin.test.assertEquals

/** The Gradle build has the modules and versions of the POMs. */
class GradleTest {
    @Test
    fun `the catalog names the versions of the POMs`() {
        val catalog = lines("gradle/libs.versions.toml", after = "[versions]", pattern = """([a-z0-9-]+) = "(.+)"""")
        assertEquals(versions().toSortedMap(), (catalog - GRADLE_ONLY).toSortedMap())
    }

    @Test
    fun `both build the same version of the product`() {
        val properties = Properties().apply { Poms.root.resolve("gradle.properties").reader().use(::load) }
        val parent = Poms.children(Poms.parent()).associate { it.tagName to it.textContent }
        assertEquals(parent["groupId"], properties["group"])
        assertEquals(parent["version"], properties["version"])
    }

    @Test
    fun `both build the same modules`() {
        val settings = lines("settings.gradle.kts", after = "val modules = listOf(", pattern = """ +("([a-z-]+)"),""")
        assertEquals(Poms.modules, settings.values.toList())
    }

    /** All POMs' properties `NAME.version` and `java.release` by name, without those of Maven's own plugins. */
    private fun versions(): Map<String, String> = (Poms.modules.map(Poms::of) + Poms.parent())
        .flatMap { Poms.elements(it, "properties") }
        .flatMap(Poms::children)
        .filterNot { it.tagName.endsWith("-plugin.version") }
        .filter { it.tagName.endsWith(".version") || it.tagName == "java.release" }
        .associate { it.tagName.substringBefore('.') to it.textContent }

    /** The two groups of [pattern] in the lines of a file that follow the line [after], up to the first that does not match. */
    private fun lines(path: String, after: String, pattern: String): Map<String, String> = Poms.root.resolve(path).readLines()
        .dropWhile { it != after }
        .drop(1)
        .map(Regex(pattern)::matchEntire)
        .takeWhile { it != null }
        .associate { checkNotNull(it).destructured.let { (name, value) -> name to value } }

    private companion object {
        /** Plugins that have another counterpart in Maven. */
        val GRADLE_ONLY = setOf("shadow")
    }
}
