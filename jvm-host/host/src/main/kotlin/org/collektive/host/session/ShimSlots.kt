package org.collektive.host.session

import org.collektive.frames.AnswerSlots
import org.collektive.host.jfr.SessionEvents
import org.collektive.host.jfr.SlotGrownEvent
import org.collektive.host.shim.ShimCalls
import java.nio.ByteBuffer

/** The answer slots of [shim]. Emits an event when a slot grows. */
internal class ShimSlots(private val shim: ShimCalls) : AnswerSlots {
    override fun grow(slot: Long, from: Int, to: Int): ByteBuffer? {
        val grown = shim.grow(slot, to)
        if (grown != null && SessionEvents.isRecorderInitialized) {
            val event = SlotGrownEvent()
            event.before = from.toLong()
            event.after = grown.capacity().toLong()
            event.commit()
        }
        return grown
    }
}
