package org.collektive.host.programs

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class InlineSourceMapTest {
    private val lines = InlineSourceMap.of(javaClass)

    @Test
    fun `code that the compiler inlined has the line of its call`() {
        val here = Throwable().stackTrace.first().lineNumber
        val frame = assertFailsWith<IllegalStateException> { refuse("inlined") }.stackTrace.first()
        assertTrue(frame.lineNumber > LAST_LINE, "inlined code must have line numbers beyond the end of the file: $frame")
        assertEquals(here + 1, lines.inFile(frame.lineNumber))
    }

    @Test
    fun `other lines do not change, nor do lines of classes without inlined code`() {
        for (line in 1..LAST_LINE) assertEquals(line, lines.inFile(line))
        assertEquals(500, InlineSourceMap.of(Any::class.java).inFile(500))
        assertEquals(500, InlineSourceMap.of(Runnable {}.javaClass).inFile(500))
        // The lines are joined at run time, because a single constant would be taken for the source map of this class.
        val invalidMap = listOf("SMAP", "x", "Kotlin", "*S KotlinDebug", "*L", "nonsense#1:1,,", "*E").joinToString("\n")
        assertEquals(500, InlineSourceMap.of(invalidMap.encodeToByteArray()).inFile(500))
    }

    @Suppress("NOTHING_TO_INLINE")
    private inline fun refuse(why: String): Nothing = throw IllegalStateException(why)

    private companion object {
        /** The number of lines in this file. */
        const val LAST_LINE = 36
    }
}
