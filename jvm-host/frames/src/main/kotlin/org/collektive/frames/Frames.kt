package org.collektive.frames

import java.nio.ByteBuffer
import java.nio.ByteOrder

/**
 * Sets position and limit of [slot] to the frame of [length] bytes at [offset], and its order to little-endian. Returns [slot].
 *
 * @throws MalformedFrameException when the frame does not lie inside the slot.
 */
public fun frameIn(slot: ByteBuffer, offset: Int, length: Int): ByteBuffer {
    if (offset < 0 || length < OFFSET_BYTES || offset.toLong() + length > slot.capacity()) {
        throw MalformedFrameException("bytes $offset to ${offset.toLong() + length} lie outside the slot of ${slot.capacity()} bytes")
    }
    return slot.clear().position(offset).limit(offset + length).order(ByteOrder.LITTLE_ENDIAN)
}

/**
 * Returns the position of the table or vector that a field of [table] references, or 0 if the field is absent.
 *
 * [entry] is the offset of the field in the vtable, in bytes. [FrameChecker] must have verified the table.
 */
public fun target(frame: ByteBuffer, table: Int, entry: Int): Int {
    val vtable = table - frame.getInt(table)
    val at = if (entry < frame.getShort(vtable)) frame.getShort(vtable + entry).toInt() else 0
    return if (at == 0) 0 else table + at + frame.getInt(table + at)
}
