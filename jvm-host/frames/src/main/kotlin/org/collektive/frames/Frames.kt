package org.collektive.frames

import java.nio.ByteBuffer
import java.nio.ByteOrder

/**
 * The frame in the bytes [offset] until [offset] + [length] of [slot]: makes them the slot's position and limit, little-endian.
 *
 * @throws MalformedFrameException when they do not lie inside the slot.
 */
public fun frameIn(slot: ByteBuffer, offset: Int, length: Int): ByteBuffer {
    if (offset < 0 || length < OFFSET_BYTES || offset.toLong() + length > slot.capacity()) {
        throw MalformedFrameException("bytes $offset to ${offset.toLong() + length} do not lie in its slot of ${slot.capacity()} bytes")
    }
    return slot.clear().position(offset).limit(offset + length).order(ByteOrder.LITTLE_ENDIAN)
}

/**
 * Where the table or vector lies to which the field at [entry] (bytes into the vtable) of [table] leads; 0 when the field is absent.
 * For tables of [frame] that passed a check.
 */
public fun target(frame: ByteBuffer, table: Int, entry: Int): Int {
    val vtable = table - frame.getInt(table)
    val at = if (entry < frame.getShort(vtable)) frame.getShort(vtable + entry).toInt() else 0
    return if (at == 0) 0 else table + at + frame.getInt(table + at)
}
