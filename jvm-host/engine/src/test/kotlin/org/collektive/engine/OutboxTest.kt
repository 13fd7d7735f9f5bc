package org.collektive.engine

import org.collektive.spi.Export
import org.junit.jupiter.api.Test
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertNull
import kotlin.test.assertSame

class OutboxTest {
    private val box = object : Outbox() {}

    private class Sent : Export()

    @Test
    fun `a node that never sent has no message`() {
        assertNull(box.last)
        assertNull(box.readable(tick = 1))
        assertEquals(0, box.sentAt)
    }

    @Test
    fun `a message is readable from the tick after it was sent`() {
        val sent = Sent()
        box.send(sent, tick = 3, time = 0.3)
        assertNull(box.readable(tick = 3))
        assertSame(sent, box.readable(tick = 4))
        assertEquals(3, sent.tick)
        assertEquals(0.3, box.sentTime)
    }

    @Test
    fun `rounds before and after the sender's round read the same message, whichever ticks the sender skips`() {
        val random = Random(1)
        var last: Export? = null
        for (tick in 1L..1000L) {
            assertSame(last, box.readable(tick), "tick $tick, before the sender's round")
            if (random.nextInt(3) == 0) continue
            val sent = Sent()
            box.send(sent, tick, time = tick * 0.1)
            assertSame(last, box.readable(tick), "tick $tick, after the sender's round")
            assertSame(sent, box.readable(tick + 1), "tick $tick in a sequential schedule")
            assertSame(sent, box.last)
            last = sent
        }
    }
}
