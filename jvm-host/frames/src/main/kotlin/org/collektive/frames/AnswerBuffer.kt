package org.collektive.frames

import com.google.flatbuffers.FlatBufferBuilder
import java.nio.ByteBuffer
import java.nio.ByteOrder

/** Provides the memory of answers, which the implementation owns. */
public fun interface AnswerSlots {
    /**
     * Grows the buffer of [slot] from [from] to at least [to] bytes, and returns the new one; `null` when memory is exhausted. The old
     * buffer stays readable until the answer is finished.
     */
    public fun grow(slot: Long, from: Int, to: Int): ByteBuffer?
}

/** Builds an answer in place, in a slot that grows on demand. Not thread-safe. */
public class AnswerBuffer(private val slots: AnswerSlots) : FlatBufferBuilder.ByteBufferFactory() {
    /** Reused for each answer; owns no memory. */
    public val builder: FlatBufferBuilder = FlatBufferBuilder(EMPTY, this)
    private var slot = 0L

    /** The buffer that contains the answer. Changes when the slot grows. */
    public var memory: ByteBuffer = EMPTY
        private set

    /** Begins an answer in [answer], the current buffer of [slot]. */
    public fun begin(slot: Long, answer: ByteBuffer) {
        this.slot = slot
        memory = answer
        builder.init(answer, this)
    }

    /** Ends the answer with the root table [root]. Returns its position in [memory], in bytes: `offset << 32 | length`. */
    public fun finish(root: Int): Long {
        builder.finish(root)
        val length = builder.offset()
        return (memory.capacity() - length).toLong() shl 32 or length.toLong()
    }

    /** Writes a [text] of user code. Replaces unpaired surrogates, which the [builder] would refuse. Returns its position. */
    internal fun text(text: String): Int = builder.createString(ByteBuffer.wrap(text.encodeToByteArray()))

    /** Converts a distance [fromEnd] of [memory], in bytes, to a position from its start. */
    internal fun position(fromEnd: Int): Int = memory.capacity() - fromEnd

    /** Called by [builder]. */
    override fun newByteBuffer(capacity: Int): ByteBuffer {
        memory = slots.grow(slot, memory.capacity(), capacity)?.order(ByteOrder.LITTLE_ENDIAN)
            ?: throw OutOfMemoryError("cannot allocate native memory for an answer of $capacity bytes")
        return memory
    }

    private companion object {
        val EMPTY: ByteBuffer = ByteBuffer.allocate(0)
    }
}
