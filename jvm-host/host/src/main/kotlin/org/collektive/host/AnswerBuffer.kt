package org.collektive.host

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.host.jfr.SessionEvents
import org.collektive.host.jfr.SlotGrownEvent
import java.nio.ByteBuffer
import java.nio.ByteOrder

/** Builds an answer in place, in a slot of the shim's that grows when it must. */
internal class AnswerBuffer(private val shim: ShimCalls) : FlatBufferBuilder.ByteBufferFactory() {
    /** Used again and again; holds no memory of its own. */
    val builder = FlatBufferBuilder(EMPTY, this)
    private var slot = 0L
    private var buffer: ByteBuffer = EMPTY

    fun begin(slot: Long, answer: ByteBuffer) {
        this.slot = slot
        buffer = answer
        builder.init(answer, this)
    }

    /** Ends the answer and returns `offset << 32 | length`. */
    fun finish(root: Int): Long {
        builder.finish(root)
        val length = builder.offset()
        return (buffer.capacity() - length).toLong() shl 32 or length.toLong()
    }

    /** Where in the buffer the byte is that was written [fromEnd] bytes before the end. */
    fun position(fromEnd: Int): Int = buffer.capacity() - fromEnd

    val memory: ByteBuffer get() = buffer

    override fun newByteBuffer(capacity: Int): ByteBuffer {
        val before = buffer.capacity()
        buffer = shim.grow(slot, capacity)?.order(ByteOrder.LITTLE_ENDIAN)
            ?: throw OutOfMemoryError("no native memory for an answer of $capacity bytes")
        if (SessionEvents.wanted) {
            val event = SlotGrownEvent()
            event.before = before.toLong()
            event.after = buffer.capacity().toLong()
            event.commit()
        }
        return buffer
    }

    private companion object {
        val EMPTY: ByteBuffer = ByteBuffer.allocate(0)
    }
}
