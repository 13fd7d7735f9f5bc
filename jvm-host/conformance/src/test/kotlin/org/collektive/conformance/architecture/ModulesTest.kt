package org.collektive.conformance.architecture

import org.w3c.dom.Element
import kotlin.test.Test
import kotlin.test.assertEquals

/** Compares `docs/architecture.md` with the modules' POMs. */
class ModulesTest {
    private val page = Poms.root.resolve("docs/architecture.md").readText()

    @Test
    fun `the diagram shows the dependencies of all modules`() {
        val arrow = Regex("""^ +([a-z-]+) (-->|-\.->) ([a-z-]+)$""", RegexOption.MULTILINE)
        val drawn = arrow.findAll(page).map { it.value.trim() }.sorted().toList()
        assertEquals(Poms.modules.flatMap(::arrows).sorted(), drawn)
    }

    @Test
    fun `the table names every module`() {
        val row = Regex("""^\| `([a-z-]+)` \|""", RegexOption.MULTILINE)
        val listed = row.findAll(page).map { it.groupValues[1] }.toSet()
        assertEquals(Poms.modules.toSet(), listed.intersect(Poms.modules.toSet()))
    }

    /**
     * Returns the arrows of the diagram that begin at [module].
     *
     * A solid arrow is a dependency of the module's classes. A dotted arrow is a tool that only its build needs, to generate or compile
     * sources.
     */
    private fun arrows(module: String): List<String> = Poms.elements(Poms.of(module), "dependency")
        .filter { it.text("groupId") == "org.collektive" && it.text("scope") != "test" }
        .map { "$module ${if (it.text("artifactId") in BUILD_TOOLS) "-.->" else "-->"} ${it.text("artifactId")}" }

    private fun Element.text(name: String) = getElementsByTagName(name).item(0)?.textContent

    private companion object {
        val BUILD_TOOLS = setOf("generator", "lifter", "compiler-plugin")
    }
}
