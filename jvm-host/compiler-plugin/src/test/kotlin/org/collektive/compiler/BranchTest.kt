package org.collektive.compiler

import kotlin.test.Test
import kotlin.test.assertEquals

class BranchTest {
    @Test
    fun `devices in different arms of an if do not see each other`() = assertSeen("ifElse", 0 to setOf(2), 1 to setOf(3))

    @Test
    fun `arms of a when with a subject`() = assertSeen("whenSubject", 0 to setOf(), 1 to setOf(), 2 to setOf(3), 3 to setOf(2))

    @Test
    fun `arms of a when without a subject`() = assertSeen("whenPlain", 0 to setOf(), 1 to setOf(2, 3))

    @Test
    fun `the right sides of elvis, and, or`() {
        assertSeen("elvis", 0 to setOf(2), 1 to setOf())
        assertSeen("and", 0 to setOf(2), 1 to setOf())
        assertSeen("or", 0 to setOf(2), 1 to setOf())
    }

    @Test
    fun `conditions are not part of an arm`() = assertSeen("condition", 0 to setOf(1, 2, 3), 1 to setOf(0, 2, 3))

    @Test
    fun `a lambda called in both arms does not align across them`() = assertSeen("lambdaInArms", 0 to setOf(2), 1 to setOf(3))

    @Test
    fun `a function parameter called in both arms does not align across them`() =
        assertSeen("parameterInArms", 0 to setOf(2), 1 to setOf(3))

    @Test
    fun `a local function called in both arms does not align across them`() = assertSeen("functionInArms", 0 to setOf(2), 1 to setOf(3))

    @Test
    fun `a function of an object that keeps the Aggregate does not align across the arms`() {
        assertSeen("keeperInArms", 0 to setOf(2), 1 to setOf(3))
        assertSeen("keeperOfKeeperInArms", 0 to setOf(2), 1 to setOf(3))
    }

    @Test
    fun `an arm that only returns does not affect devices that continue`() = assertSeen("earlyReturn", 1 to setOf(3), 3 to setOf(1))

    @Test
    fun `nested arms`() = assertSeen("nested", 0 to setOf(), 2 to setOf(), 1 to setOf(3))

    @Test
    fun `arms have names in the path`() {
        assertEquals(listOf("if > neighboring"), trace(compiled.program("ifElse")).second)
        assertEquals(listOf("when 1 > neighboring"), trace(compiled.program("whenSubject")).second)
        assertEquals(listOf("?: > neighboring"), trace(compiled.program("elvis")).second)
        assertEquals(listOf("&& > neighboring"), trace(compiled.program("and")).second)
        assertEquals(listOf("|| > neighboring"), trace(compiled.program("or")).second)
    }

    private fun assertSeen(program: String, vararg expected: Pair<Int, Set<Int>>) = assertSeen(compiled, program, expected)

    private companion object {
        val compiled = Compilation.of(
            """
            val Aggregate<Int>.even: Boolean get() = localId % 2 == 0
            fun Aggregate<Int>.seen(): Set<Int> = ids(neighboring(localId))
            fun ids(field: Field<Int, Int>): Set<Int> = field.neighbors.list.map { it.id }.toSet()

            fun Aggregate<Int>.ifElse(): Set<Int> = if (even) ids(neighboring(0)) else ids(neighboring(0))

            fun Aggregate<Int>.whenSubject(): Set<Int> = when (localId) {
                0 -> ids(neighboring(0))
                1 -> seen()
                else -> seen()
            }

            fun Aggregate<Int>.whenPlain(): Set<Int> = when {
                localId > 0 -> seen()
                else -> seen()
            }

            fun Aggregate<Int>.elvis(): Set<Int> = nothingFor(!even) ?: ids(neighboring(0))
            fun nothingFor(odd: Boolean): Set<Int>? = if (odd) setOf() else null

            fun Aggregate<Int>.and(): Set<Int> {
                var result = setOf<Int>()
                val unused = even && ids(neighboring(0)).also { result = it }.isEmpty()
                return result
            }

            fun Aggregate<Int>.or(): Set<Int> {
                var result = setOf<Int>()
                val unused = !even || ids(neighboring(0)).also { result = it }.isEmpty()
                return result
            }

            fun Aggregate<Int>.condition(): Set<Int> {
                val seen: Set<Int>
                if (seen().also { seen = it }.size > 1 && even) evolve(0) { it } else evolve(1) { it }
                return seen
            }

            fun Aggregate<Int>.lambdaInArms(): Set<Int> {
                val look = { seen() }
                return if (even) look() else look()
            }

            fun Aggregate<Int>.parameterInArms(): Set<Int> = chosen { seen() }
            fun Aggregate<Int>.chosen(look: () -> Set<Int>): Set<Int> = if (even) look() else look()

            fun Aggregate<Int>.functionInArms(): Set<Int> {
                fun look() = seen()
                return if (even) look() else look()
            }

            class Keeper(private val device: Aggregate<Int>) { fun look(): Set<Int> = device.seen() }
            fun Aggregate<Int>.keeperInArms(): Set<Int> { val keeper = Keeper(this); return if (even) keeper.look() else keeper.look() }
            class Team(private val keeper: Keeper) { fun look(): Set<Int> = keeper.look() }
            fun Aggregate<Int>.keeperOfKeeperInArms(): Set<Int> { val team = Team(Keeper(this)); return if (even) team.look() else team.look() }

            fun Aggregate<Int>.earlyReturn(): Set<Int> {
                if (even) return setOf()
                return seen()
            }

            fun Aggregate<Int>.nested(): Set<Int> = if (even) { if (localId == 0) seen() else seen() } else seen()
            """,
        )
    }
}
