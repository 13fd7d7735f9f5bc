package org.collektive.frames.data

import com.google.flatbuffers.Table
import it.unibo.collektive.stdlib.util.Maybe
import it.unibo.collektive.stdlib.util.Point2D
import org.junit.jupiter.api.Test
import java.nio.ByteBuffer
import java.util.Optional
import java.util.concurrent.atomic.AtomicReference
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertNull

class ViewRuleTest {
    private class Sensors : Table()

    private class Reading(val sensors: Sensors?)

    private class Named(val name: String, val content: Any?)

    private class Cell(val content: Optional<Sensors>?)

    private class Chain(val next: Chain?, val content: Sensors?)

    private open class Base(private val hidden: Any?)

    private class Derived(hidden: Any?) : Base(hidden)

    private class Numbers(val x: Double, val all: IntArray, val text: String?)

    private val view = Sensors()

    @Test
    fun `a view is refused by name`() {
        assertContains(ViewRule.refusal(view).orEmpty(), "a ${Sensors::class.java.name} is a view of the frame's memory")
        assertNotNull(ViewRule.refusal(ByteBuffer.allocate(1)))
    }

    @Test
    fun `a value that contains a view is refused`() {
        val holders = listOf(
            1 to view, view to 1,
            Triple(
                1,
                2,
                view,
            ),
            listOf(1, view), arrayListOf<Any>(view), setOf(view), mapOf(1 to view), mapOf(view to 1), arrayOf(view),
            Reading(view), Named("now", view), Chain(Chain(null, view), null), Derived(view), Maybe.some(view), sequenceOf(view),
            listOf(1 to listOf(Named("deep", view))), { view }, Optional.of(view), AtomicReference(view), Cell(Optional.of(view)),
        )
        for (holder in holders) {
            val refusal = assertNotNull(ViewRule.refusal(holder), holder.toString())
            assertContains(refusal, "a ${Sensors::class.java.name} inside a ${holder.javaClass.name} is a view")
        }
    }

    @Test
    fun `all other values can be shared`() {
        val ring = arrayOfNulls<Any>(1).also { it[0] = it }
        val values = listOf(
            null, 1, "text", 2.0, Unit, Thread.State.NEW, intArrayOf(1), 1 to 2, listOf(1, "a", null), emptyMap<Any, Any>(), Reading(null),
            Optional.empty<Any>(), Optional.of("text"), AtomicReference<Any>(), Cell(null),
            Named("now", listOf(1)), Numbers(1.0, intArrayOf(2), null), Maybe.none, Point2D(1.0 to 2.0), ring,
        )
        assertEquals(emptyList(), values.filter { ViewRule.refusal(it) != null })
        assertNull(ViewRule.refusal(List(100_000) { it }))
    }
}
