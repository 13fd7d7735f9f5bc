package org.collektive.generator

import kotlin.io.path.appendText
import kotlin.io.path.createSymbolicLinkPointingTo
import kotlin.io.path.writeText
import kotlin.test.Test
import kotlin.test.assertNotEquals

internal class SourceHashTest {
    @Test
    fun `the hash covers each included file`() {
        val folder = Fixture.newFolder()
        val schema = folder.resolve("a.fbs")
        schema.writeText("/* types */ include\"b.fbs\"; include /* c */ // d\n'c.fbs';\nnamespace a;")
        val included = listOf("b.fbs", "c.fbs").map(folder::resolve)
        for (file in included) file.writeText("namespace a;")
        for (file in included) {
            val before = SourceHash.of(schema, emptyList())
            file.appendText("struct A { x: int; }")
            assertNotEquals(before, SourceHash.of(schema, emptyList()))
        }
    }

    @Test
    fun `the hash covers programs in linked folders`() {
        val schema = Fixture.newFolder().resolve("a.fbs").also { it.writeText("namespace a;") }
        val linked = Fixture.newFolder()
        val programs = Fixture.newFolder().also { it.resolve("linked").createSymbolicLinkPointingTo(linked) }
        val before = SourceHash.of(schema, listOf(programs))
        linked.resolve("A.kt").writeText("fun a() = 1")
        assertNotEquals(before, SourceHash.of(schema, listOf(programs)))
    }
}
