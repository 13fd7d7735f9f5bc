package org.collektive.frames.data

import java.nio.ByteBuffer
import java.nio.ByteOrder

/**
 * Keeps a copy of the last `GlobalData`, which outlives its frame.
 *
 * The copy is double-buffered, so a tick that is rejected after [read] does not change the copy in use.
 */
internal class GlobalData(newReader: () -> GlobalReader) {
    private val copies = Array(2) { Copy(newReader()) }
    private var inUse = 0

    /** Checks and copies the `GlobalData` at [position] of [frame], and returns a view of the copy. [accept] makes it current. */
    fun read(frame: ByteBuffer, position: Int): Any = copies[1 - inUse].read(frame, position)

    /** Makes the data last read current. Call it once its tick is accepted. */
    fun accept() {
        inUse = 1 - inUse
    }

    private class Copy(private val reader: GlobalReader) {
        private var bytes = ByteBuffer.allocate(0)

        fun read(frame: ByteBuffer, position: Int): Any {
            reader.attach(frame, position)
            reader.check()
            val length = frame.remaining()
            if (bytes.capacity() < length) bytes = ByteBuffer.allocate(2 * length).order(ByteOrder.LITTLE_ENDIAN)
            bytes.clear().put(0, frame, frame.position(), length).limit(length)
            reader.attach(bytes, position - frame.position())
            return reader.data
        }
    }
}
