package it.unibo.collektive.aggregate.api

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals

class YieldingTest {
    private fun <S, R> step(old: S, scope: YieldingScope<S, R>) = YieldingContext<S, R>().scope(old)

    @Test
    fun `the yielded value is stored, and the result of the lambda is returned`() =
        assertEquals(YieldingResult(4, "round 4"), step(3) { old -> (old + 1).yielding { "round $this" } })

    @Test
    fun `null can be stored and returned`() {
        assertEquals(YieldingResult<Int?, String>(null, "nothing"), step<Int?, String>(3) { null.yielding { "nothing" } })
        assertEquals(YieldingResult<Int, String?>(3, null), step<Int, String?>(3) { it.yielding { null } })
    }

    @Test
    fun `the last yielding of a step counts`() = assertEquals(
        YieldingResult(2, 20),
        step(0) {
            1.yielding { 10 }
            2.yielding { 20 }
        },
    )
}
