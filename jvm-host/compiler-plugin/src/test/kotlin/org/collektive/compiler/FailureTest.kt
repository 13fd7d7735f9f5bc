package org.collektive.compiler

import org.junit.jupiter.api.assertThrows
import kotlin.test.Test
import kotlin.test.assertEquals

/** Tests that the path of a failure is recorded, although the stack is empty when the exception leaves the round. */
class FailureTest {
    @Test
    fun `an exception has the path where it was thrown`() = assertFails("plain", "helper > if > deep", "Program.kt:2")

    @Test
    fun `calls that have returned are not in the path`() = assertFails("afterwards", "helper", "Program.kt:4")

    @Test
    fun `arms are in the path, and lambdas where they run`() = assertFails("arms", "if > run", "Program.kt:5")

    @Test
    fun `a caught exception does not affect the path of a later one`() = assertFails("caught", "deep", "Program.kt:8")

    @Test
    fun `a rethrown exception keeps its path`() = assertFails("again", "helper > if > deep", "Program.kt:2")

    @Test
    fun `a failure outside all calls has no path`() {
        val network = referenceNetwork(0)
        assertThrows<IllegalStateException> { network.round(compiled.program("root")) }
        assertEquals(null, network.firstAligned.failed)
    }

    @Test
    fun `devices of other implementations pass exceptions on`() {
        assertThrows<IllegalStateException> { referenceNetwork(0, plain = true).round(compiled.program("plain")) }
    }

    private fun assertFails(program: String, path: String, location: String) {
        val network = referenceNetwork(0)
        val thrown = assertThrows<IllegalStateException> { network.round(compiled.program(program)) }
        val (place, failure) = checkNotNull(network.firstAligned.failed)
        assertEquals(listOf(thrown, path, location), listOf(failure, place.path, place.location))
    }

    private companion object {
        val compiled = Compilation.of(
            """
            fun Aggregate<Int>.deep(): Int = if (localId < 0) 1 else error("deep")
            fun Aggregate<Int>.helper(fails: Boolean = true): Int { neighboring(localId); return if (fails) deep() else error("after") }
            fun Aggregate<Int>.plain(): Int = helper()
            fun Aggregate<Int>.afterwards(): Int = neighboring(localId).local.value + helper(fails = false)
            fun Aggregate<Int>.arms(): Int = if (localId == 0) { run { evolve(0) { it }; error("in an arm") } } else 1
            fun Aggregate<Int>.caught(): Int {
                try { helper() } catch (_: IllegalStateException) { evolve(0) { it } }
                return deep()
            }
            fun Aggregate<Int>.again(): Int = try { helper() } catch (e: IllegalStateException) { evolve(0) { it }; throw e }
            fun Aggregate<Int>.root(): Int { evolve(0) { it }; error("root") }
            """,
        )
    }
}
