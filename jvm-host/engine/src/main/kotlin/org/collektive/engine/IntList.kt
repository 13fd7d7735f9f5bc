package org.collektive.engine

import java.nio.ByteBuffer

/** A growable list of unboxed ints. [clear] keeps the memory. */
public class IntList {
    private var items = IntArray(16)

    /** The number of elements. */
    public var size: Int = 0
        private set

    /** Returns the element at [index], which must be below [size]. */
    public operator fun get(index: Int): Int = items[index]

    /** Appends [value]. */
    public fun add(value: Int) {
        if (size == items.size) items = items.copyOf(2 * size)
        items[size++] = value
    }

    /** Appends [count] ints from [source], starting at byte [position], in the buffer's byte order. */
    public fun addAll(source: ByteBuffer, position: Int, count: Int) {
        if (items.size - size < count) items = items.copyOf(maxOf(size + count, 2 * items.size))
        for (index in 0 until count) items[size + index] = source.getInt(position + index * Int.SIZE_BYTES)
        size += count
    }

    /** Removes all elements. */
    public fun clear() {
        size = 0
    }
}
