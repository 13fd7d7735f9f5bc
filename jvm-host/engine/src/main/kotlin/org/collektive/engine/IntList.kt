package org.collektive.engine

/** Ints without boxes; keeps its memory when cleared. */
public class IntList {
    private var items = IntArray(16)

    /** How many there are. */
    public var size: Int = 0
        private set

    /** The element at [index], which must be below [size]. */
    public operator fun get(index: Int): Int = items[index]

    /** Appends [value]. */
    public fun add(value: Int) {
        if (size == items.size) items = items.copyOf(2 * size)
        items[size++] = value
    }

    /** Forgets all elements. */
    public fun clear() {
        size = 0
    }
}
