package org.collektive.engine

import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.security.MessageDigest

/**
 * The chained proof of what a session computed: `d[0]` = 32 zero bytes; `d[k]` = SHA-256 of `d[k-1]`, the tick (u64), then for each due
 * node in id order its id (i32), the length of its answer (i32; -1 without one) and the answer's bytes. Little-endian.
 *
 * Called [begin], then [answer] or [failure] for each node, then [end]. Allocates nothing.
 */
public class RoundDigest {
    private val sha256 = MessageDigest.getInstance("SHA-256")
    private val chain = ByteArray(LENGTH)
    private val head = ByteBuffer.wrap(chain).order(ByteOrder.LITTLE_ENDIAN)
    private val staging = ByteBuffer.allocate(STAGING_BYTES).order(ByteOrder.LITTLE_ENDIAN)

    /** First 8 bytes of the chain, little-endian. */
    public val value: Long get() = head.getLong(0)

    /** Begins [tick]. */
    public fun begin(tick: Long) {
        staging.clear()
        staging.put(chain).putLong(tick)
    }

    /** Adds the answer of [node]: the bytes [offset] until [offset] + [length] of [buffer]. */
    public fun answer(node: Int, buffer: ByteBuffer, offset: Int, length: Int) {
        header(node, length)
        var done = 0
        while (done < length) {
            if (!staging.hasRemaining()) flush()
            val part = minOf(length - done, staging.remaining())
            buffer.get(offset + done, staging.array(), staging.position(), part)
            staging.position(staging.position() + part)
            done += part
        }
    }

    /** Notes that [node] gave no answer. */
    public fun failure(node: Int) {
        header(node, -1)
    }

    /** Ends the tick. */
    public fun end() {
        flush()
        sha256.digest(chain, 0, LENGTH)
    }

    private fun header(node: Int, length: Int) {
        if (staging.remaining() < 2 * Int.SIZE_BYTES) flush()
        staging.putInt(node).putInt(length)
    }

    private fun flush() {
        sha256.update(staging.array(), 0, staging.position())
        staging.clear()
    }

    private companion object {
        const val LENGTH = 32
        const val STAGING_BYTES = 8192
    }
}
