package org.collektive.engine

import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.security.MessageDigest

/**
 * The chained digest of a session's answers. Sessions with the same digest returned identical answers.
 *
 * `d[0]` is 32 zero bytes. `d[k]` is the SHA-256 of `d[k-1]` and the tick (u64), then for each due node in id order its id (i32), the
 * length of its answer in bytes (i32; -1 if the round failed) and the answer. All integers are little-endian.
 *
 * Call [begin], then [answer] or [failure] for each node, or [answers] for several, then [end]. Allocates nothing. Not thread-safe.
 */
public class RoundDigest {
    private val sha256 = MessageDigest.getInstance("SHA-256")
    private val chain = ByteArray(LENGTH)
    private val head = ByteBuffer.wrap(chain).order(ByteOrder.LITTLE_ENDIAN)
    private val staging = ByteBuffer.allocate(STAGING_BYTES).order(ByteOrder.LITTLE_ENDIAN)

    /** The first 8 bytes of the chain, little-endian. */
    public val value: Long get() = head.getLong(0)

    /** Begins [tick]. */
    public fun begin(tick: Long) {
        staging.clear()
        staging.put(chain).putLong(tick)
    }

    /** Adds the answer of [node]: [length] bytes of [buffer] at [offset]. */
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

    /** Adds the answers in the bytes [begin] until [end] of [entries], each preceded by its [putHeader]. */
    public fun answers(entries: ByteArray, begin: Int, end: Int) {
        flush()
        sha256.update(entries, begin, end - begin)
    }

    /** Adds the failed round of [node]. */
    public fun failure(node: Int) {
        header(node, -1)
    }

    /** Ends the tick. */
    public fun end() {
        flush()
        sha256.digest(chain, 0, LENGTH)
    }

    private fun header(node: Int, length: Int) {
        if (staging.remaining() < HEADER_BYTES) flush()
        putHeader(staging, staging.position(), node, length)
        staging.position(staging.position() + HEADER_BYTES)
    }

    private fun flush() {
        sha256.update(staging.array(), 0, staging.position())
        staging.clear()
    }

    public companion object {
        /** Size of the header that precedes each answer. */
        public const val HEADER_BYTES: Int = 2 * Int.SIZE_BYTES
        private const val LENGTH = 32
        private const val STAGING_BYTES = 8192

        /** Writes the header of the answer of [node], which has [length] bytes, to [entries] at [offset]; [entries] is little-endian. */
        public fun putHeader(entries: ByteBuffer, offset: Int, node: Int, length: Int) {
            entries.putInt(offset, node).putInt(offset + Int.SIZE_BYTES, length)
        }
    }
}
