package org.collektive.frames.data

import java.nio.ByteBuffer
import java.nio.ByteOrder

/**
 * Keeps the last `GlobalData` readable after its frame is gone.
 *
 * Two copies take turns, so that a frame that is refused later leaves the one in use alone.
 */
internal class GlobalData(newReader: () -> GlobalReader) {
    private val copies = Array(2) { Copy(newReader()) }
    private var inUse = 0

    /** Checks and copies the `GlobalData` at [position] of [frame] and returns its view; in use after [accept]. */
    fun read(frame: ByteBuffer, position: Int): Any = copies[1 - inUse].read(frame, position)

    /** The tick with the data last read was accepted. */
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
