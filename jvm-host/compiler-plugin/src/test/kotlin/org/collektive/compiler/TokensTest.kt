package org.collektive.compiler

import org.collektive.alignment.location
import org.collektive.alignment.readable
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertSame
import kotlin.test.assertTrue

class TokensTest {
    @Test
    fun `a token names the call and its location, and ends with a 64-bit hash`() {
        val token = tokens(compiled).first().first()
        assertTrue(Regex("first@Program\\.kt:5#[0-9a-f]{16}").matches(token), token)
        assertEquals("first", readable(token))
        assertEquals("Program.kt:5", location(token))
    }

    @Test
    fun `builds in different folders make the same tokens`() = assertEquals(tokens(compiled), tokens(Compilation.of(SOURCE)))

    @Test
    fun `two modules with files of the same name have different tokens`() {
        val elsewhere = tokens(Compilation.of(SOURCE, module = "elsewhere"))
        assertEquals(emptySet(), tokens(compiled).flatten().toSet() intersect elsewhere.flatten().toSet())
    }

    @Test
    fun `a new call keeps the tokens of calls with other names`() {
        val calls = "share(1) { it.local.value } + if (localId == 0) neighboring(2).local.value else 0"
        val before = tokens(Compilation.of("fun Aggregate<Int>.main(): Int = $calls"))
        assertEquals(before, tokens(Compilation.of("fun Aggregate<Int>.main(): Int = evolve(1) { it } + $calls")).drop(1))
    }

    @Test
    fun `each call has its own token`() {
        val places = tokens(compiled).flatten()
        // The tokens belong to the calls of `first` and `twice` in main, of `first` in the lambda, and of `neighboring` in both overloads.
        assertEquals(7, places.toSet().size)
    }

    @Test
    fun `equal tokens are the same object`() {
        val (once, again) = List(2) { tokens(compiled) }
        for ((a, b) in once.flatten() zip again.flatten()) assertSame(a, b)
    }

    @Test
    fun `a program's own pivots are readable as their text`() {
        assertEquals("a@b", readable("a@b"))
        assertEquals(null, location("a@b"))
        assertEquals("null", readable(null))
        assertEquals("7", readable(7))
    }

    private fun tokens(compilation: Compilation): List<List<String>> {
        val network = referenceNetwork(0)
        network.round(compilation.program("main"))
        return network.first.paths.map { path -> path.map { it as String } }
    }

    private companion object {
        const val SOURCE = """
            fun Aggregate<Int>.first(x: Int): Int = neighboring(x).local.value
            fun Aggregate<Int>.first(x: Long): Long = neighboring(x).local.value
            fun Aggregate<Int>.main(): Long {
                val twice = { first(localId) }
                return first(1) + twice() + twice() + first(2L)
            }
            """

        val compiled = Compilation.of(SOURCE)
    }
}
