package org.collektive.generator

import kotlin.io.path.appendText
import kotlin.io.path.writeText
import kotlin.test.Test
import kotlin.test.assertNotEquals

internal class SourceHashTest {
    @Test
    fun `the hash covers each included file`() {
        val folder = Fixture.newFolder()
        val schema = folder.resolve("a.fbs")
        schema.writeText("/* types */ include \"b.fbs\"; include 'c.fbs';\nnamespace a;")
        val included = listOf("b.fbs", "c.fbs").map(folder::resolve)
        for (file in included) file.writeText("namespace a;")
        for (file in included) {
            val before = SourceHash.of(schema, emptyList())
            file.appendText("struct A { x: int; }")
            assertNotEquals(before, SourceHash.of(schema, emptyList()))
        }
    }
}
