package org.collektive.frames.data

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.frames.OFFSET_BYTES

/** Writes a vector of [count] elements of [bytes] bytes with alignment [alignment]; [add] writes one of them. Returns its offset. */
public inline fun FlatBufferBuilder.vector(bytes: Int, alignment: Int, count: Int, add: (Int) -> Unit): Int {
    startVector(bytes, count, alignment)
    for (i in count - 1 downTo 0) add(i)
    return endVector()
}

/** Writes a vector of [count] strings or tables. [make] writes one of them and returns its offset. Returns the offset of the vector. */
public inline fun FlatBufferBuilder.references(count: Int, make: (Int) -> Int): Int {
    val offsets = IntArray(count) { make(it) }
    return vector(OFFSET_BYTES, OFFSET_BYTES, count) { addOffset(offsets[it]) }
}
