package org.collektive.frames

import com.google.flatbuffers.FlatBufferBuilder
import java.nio.ByteBuffer
import java.nio.ByteOrder

/** The memory of answers, which somebody else owns. */
public fun interface AnswerSlots {
    /**
     * A buffer of at least [to] bytes for the answer [slot], whose present one has [from] bytes; `null` without memory. The present one
     * stays readable until the answer is finished.
     */
    public fun grow(slot: Long, from: Int, to: Int): ByteBuffer?
}

/** Builds an answer in place, in a slot that grows when it must. One thread at a time. */
public class AnswerBuffer(private val slots: AnswerSlots) : FlatBufferBuilder.ByteBufferFactory() {
    /** Reused for each answer; owns no memory. */
    public val builder: FlatBufferBuilder = FlatBufferBuilder(EMPTY, this)
    private var slot = 0L

    /** Where the answer is built now. */
    public var memory: ByteBuffer = EMPTY
        private set

    /** Begins an answer in [answer], the present buffer of [slot]. */
    public fun begin(slot: Long, answer: ByteBuffer) {
        this.slot = slot
        memory = answer
        builder.init(answer, this)
    }

    /** Ends the answer, whose root is [root], and returns `offset << 32 | length`. */
    public fun finish(root: Int): Long {
        builder.finish(root)
        val length = builder.offset()
        return (memory.capacity() - length).toLong() shl 32 or length.toLong()
    }

    /** Position in [memory] of the byte that was written [fromEnd] bytes before the end. */
    internal fun position(fromEnd: Int): Int = memory.capacity() - fromEnd

    /** For [builder] only. */
    override fun newByteBuffer(capacity: Int): ByteBuffer {
        memory = slots.grow(slot, memory.capacity(), capacity)?.order(ByteOrder.LITTLE_ENDIAN)
            ?: throw OutOfMemoryError("no native memory for an answer of $capacity bytes")
        return memory
    }

    private companion object {
        val EMPTY: ByteBuffer = ByteBuffer.allocate(0)
    }
}
