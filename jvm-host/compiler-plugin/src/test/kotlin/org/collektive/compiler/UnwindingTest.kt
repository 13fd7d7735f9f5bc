package org.collektive.compiler

import kotlin.test.Test
import kotlin.test.assertEquals

/** Tests that every exit from an aligned region restores the stack. */
class UnwindingTest {
    @Test
    fun `early return from an arm`() = assertLastPath("returned", "mark > evolve")

    @Test
    fun `return out of an inlined lambda`() = assertLastPath("nonLocal", "mark > evolve")

    @Test
    fun `return to a label`() = assertLastPath("labelled", "evolve")

    @Test
    fun `break and continue from an arm`() = assertLastPath("broken", "evolve")

    @Test
    fun `a caught exception`() = assertLastPath("caught", "evolve")

    @Test
    fun `a caught exception from deep inside`() = assertLastPath("caughtDeep", "evolve")

    @Test
    fun `an exit from alignedOn`() = assertLastPath("leftAlignedOn", "mark > evolve")

    @Test
    fun `an align without dealign in the called function`() = assertLastPath("openAlign", "evolve", plainToo = false)

    @Test
    fun `an arm that always throws, in an expression`() = assertLastPath("inExpression", "evolve")

    private fun assertLastPath(program: String, expected: String, plainToo: Boolean = true) {
        for (plain in if (plainToo) listOf(false, true) else listOf(false)) {
            val network = referenceNetwork(0, plain = plain)
            network.round(compiled.program(program))
            assertEquals(expected, network.first.visited.last(), "plain: $plain")
        }
    }

    private companion object {
        val compiled = Compilation.of(
            """
            fun Aggregate<Int>.mark(): Int = evolve(0) { it + 1 }

            fun Aggregate<Int>.leaves(): Int {
                if (localId == 0) { neighboring(1); return 1 }
                return 2
            }
            fun Aggregate<Int>.returned(): Int { leaves(); return mark() }

            fun Aggregate<Int>.leavesLambda(): Int {
                listOf(1).forEach { run { alignedOn(it) { neighboring(1).local.value }; return it } }
                return 2
            }
            fun Aggregate<Int>.nonLocal(): Int { leavesLambda(); return mark() }

            fun Aggregate<Int>.labelled(): Int {
                run inner@{ if (neighboring(1).local.value == 1) { neighboring(2); return@inner }; neighboring(3) }
                return evolve(0) { it }
            }

            fun Aggregate<Int>.broken(): Int {
                for (i in 1..3) {
                    if (i == 1) { alignedOn(i) { neighboring(1).local.value }; continue }
                    if (i == 2) { alignedOn(i) { neighboring(2).local.value }; break }
                }
                return evolve(0) { it }
            }

            fun Aggregate<Int>.fails(): Int { neighboring(1); error("fails") }
            fun Aggregate<Int>.caught(): Int {
                try { fails() } catch (_: IllegalStateException) { }
                return evolve(0) { it }
            }
            fun Aggregate<Int>.caughtDeep(): Int {
                val x = try { 1 + run { if (localId == 0) alignedOn("deep") { run { fails() } } else 0 } } catch (_: IllegalStateException) { 1 }
                return evolve(x) { it }
            }

            inline fun <T> Aggregate<Int>.inlineAligned(key: Int, body: () -> T): T = body()
            fun Aggregate<Int>.leavesAlignedOn(): Int { inlineAligned(1) { neighboring(1); return 1 } }
            fun Aggregate<Int>.leftAlignedOn(): Int { leavesAlignedOn(); return mark() }

            fun Aggregate<Int>.forgets(): Int { align("forgotten"); return neighboring(1).local.value }
            fun Aggregate<Int>.openAlign(): Int { forgets(); return evolve(0) { it } }

            fun Aggregate<Int>.inExpression(): Int {
                for (i in 1..2) {
                    val sum = 1 + (if (i == 1) { alignedOn(i) { neighboring(i).local.value }; continue } else i) + listOf(i).size
                    if (sum < 0) return sum
                }
                return evolve(0) { it }
            }
            """,
        )
    }
}
