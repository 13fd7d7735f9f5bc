package org.collektive.frames.data

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.frames.OFFSET_BYTES

/** Writes a vector of [count] elements of [bytes] bytes and alignment [alignment]; [add] writes one. Returns its offset. */
public inline fun FlatBufferBuilder.vector(bytes: Int, alignment: Int, count: Int, add: (Int) -> Unit): Int {
    startVector(bytes, count, alignment)
    for (i in count - 1 downTo 0) add(i)
    return endVector()
}

/** Writes [count] strings or tables by [make], which returns the offset of one, and the vector of them. Returns its offset. */
public inline fun FlatBufferBuilder.references(count: Int, make: (Int) -> Int): Int {
    val offsets = IntArray(count) { make(it) }
    return vector(OFFSET_BYTES, OFFSET_BYTES, count) { addOffset(offsets[it]) }
}
