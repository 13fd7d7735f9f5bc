package org.collektive.spi

/** Converts values of previous programs to values of the programs that replace them. Not thread-safe. */
public interface Conversion {
    /** Returns [value] with the classes of the new programs, or [Lost]. */
    public fun value(value: Any?): Any?

    /** Returns [token], a call or a pivot on a path, with the classes of the new programs, or [Lost]. */
    public fun token(token: Any?): Any?

    /** Marks a value that the new programs cannot read. */
    public object Lost
}

/** The number of values that devices had [stored] before a [Conversion], and how many of them were [kept]. */
public class StoredValues(public val stored: Int, public val kept: Int)
