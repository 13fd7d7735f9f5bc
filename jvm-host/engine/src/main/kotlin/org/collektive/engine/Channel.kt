package org.collektive.engine

import org.collektive.spi.Export

/** State of a link in the model of burst losses; unknown before the first message. */
internal enum class Burst { UNKNOWN, GOOD, BAD }

/** The messages of one link under a network model: the messages in flight, and the received message. Not thread-safe. */
internal class Channel {
    /** The message received last; `null` once it has expired. */
    var received: Export? = null
        private set

    /** Tick in which the newest received message was sent; 0 before the first. */
    var receivedTick = 0L
        private set

    /** Tick of the last message that entered this link; 0 before the first. */
    var lastSentTick = 0L

    /** State of the link in the model of burst losses. */
    var burst = Burst.UNKNOWN

    private var validUntil = 0.0

    // Messages in flight, unordered.
    private var exports = NONE
    private var sentAt = LongArray(0)
    private var arrivals = DoubleArray(0)
    private var count = 0

    fun send(export: Export, tick: Long, arrival: Double) {
        if (count == exports.size) {
            val capacity = maxOf(2, 2 * count)
            exports = exports.copyOf(capacity)
            sentAt = sentAt.copyOf(capacity)
            arrivals = arrivals.copyOf(capacity)
        }
        export.retain()
        exports[count] = export
        sentAt[count] = tick
        arrivals[count++] = arrival
    }

    /** Receives all messages due by [now], in simulated seconds. Of these messages and [received], keeps the message that was sent last. */
    fun receiveDue(now: Double, retention: Double) {
        var index = 0
        while (index < count) {
            if (arrivals[index] > now) {
                index++
                continue
            }
            val export = exports[index]
            if (sentAt[index] > receivedTick) {
                received?.release()
                received = export
                receivedTick = sentAt[index]
                validUntil = arrivals[index] + retention
            } else {
                export?.release()
            }
            count--
            exports[index] = exports[count]
            sentAt[index] = sentAt[count]
            arrivals[index] = arrivals[count]
            exports[count] = null
        }
    }

    /** Drops the received message if it expired before [now], in simulated seconds. Returns whether it did. */
    fun expire(now: Double): Boolean {
        val export = received
        if (export == null || validUntil >= now) return false
        export.release()
        received = null
        return true
    }

    /** Releases all messages. Call it when the link is removed. */
    fun close() {
        received?.release()
        for (index in 0 until count) exports[index]?.release()
    }

    private companion object {
        val NONE = arrayOfNulls<Export>(0)
    }
}
