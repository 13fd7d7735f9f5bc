package org.collektive.runtime

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.toMap
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.Export
import org.collektive.spi.Inbox
import org.junit.jupiter.api.Test
import java.lang.ref.WeakReference
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertNull
import kotlin.test.assertSame

class ExportTest {
    private val runtimes = AggregateRuntimes()
    private val sender = runtimes.device(1)
    private val receiver = runtimes.device(2)

    @Suppress("UNCHECKED_CAST")
    private fun DeviceRuntime.round(inbox: Inbox, program: Aggregate<Int>.() -> Any?) =
        round(inbox, { aggregate, _ -> (aggregate as Aggregate<Int>).program() }, null)

    private fun send(value: Int): Export {
        sender.round(inboxOf(null)) { neighboring(value) }
        return sender.commit()
    }

    private fun received(export: Export?) = receiver.round(inboxOf(export)) { neighboring(0).neighbors.toMap() }

    private fun inboxOf(held: Export?) = object : Inbox {
        override val size = 1
        override val ids = arrayOf<Any>(1)

        override fun export(index: Int) = held

        override fun wasKnown(index: Int) = true
    }

    @Test
    fun `a link without a message aligns no device`() = assertEquals<Any?>(emptyMap<Int, Int>(), received(null))

    @Test
    fun `a retained export does not change`() {
        val held = List(5) { value -> send(value).also(Export::retain) }
        repeat(10) { send(100 + it) }
        for (value in held.indices) assertEquals<Any?>(mapOf(1 to value), received(held[value]))
    }

    @Test
    fun `the paths of a retained export survive freeUnused`() {
        val held = send(7).also(Export::retain)
        repeat(5000) { turn ->
            sender.round(inboxOf(null)) { alignedOn(turn) { neighboring(0).local.value } }
            sender.commit()
            runtimes.freeUnused(listOf(sender, receiver))
        }
        assertEquals<Any?>(mapOf(1 to 7), received(held))
    }

    @Test
    fun `pivots that no device uses any more are freed`() {
        class Pivot
        fun round(pivot: Any) {
            sender.round(inboxOf(null)) { alignedOn(pivot) { neighboring(0).local.value } }
            sender.commit()
            runtimes.freeUnused(listOf(sender, receiver))
        }
        val first = Pivot().let {
            round(it)
            WeakReference(it)
        }
        repeat(20_000) { round(Pivot()) }
        repeat(10) { if (first.get() != null) System.gc() }
        assertNull(first.get())
    }

    @Test
    fun `a device creates at most two more exports than are retained`() {
        val exports = HashSet<Export>()
        val last = ArrayDeque<Export>()
        repeat(50) { value ->
            val export = send(value).also(Export::retain)
            exports += export
            last.addLast(export)
            if (last.size > 3) last.removeFirst().release()
        }
        assertEquals(5, exports.size)
        last.forEach(Export::release)
        val next = send(0)
        send(1)
        assertSame(next, send(2))
    }

    @Test
    fun `releasing more often than retaining is an error`() {
        assertFailsWith<IllegalStateException> { send(0).release() }
    }
}
