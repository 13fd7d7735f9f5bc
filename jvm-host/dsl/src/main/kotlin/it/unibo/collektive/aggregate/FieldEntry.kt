package it.unibo.collektive.aggregate

/** The [value] that a [Field] has for the device [id]. */
public data class FieldEntry<out ID : Any, out T>(public val id: ID, public val value: T) {
    /** The entry for the device and the value of [pair]. */
    public constructor(pair: Pair<ID, T>) : this(pair.first, pair.second)

    /** The entry for the key and the value of [entry]. */
    public constructor(entry: Map.Entry<ID, T>) : this(entry.key, entry.value)

    /** The id and the value. */
    public val pair: Pair<ID, T> get() = id to value

    /** Returns `id=value`. */
    override fun toString(): String = "$id=$value"

    /** Returns an entry with the same id and the result of [transform] for this entry. */
    public inline fun <R> map(transform: (FieldEntry<ID, T>) -> R): FieldEntry<ID, R> = FieldEntry(id, transform(this))

    /** Returns an entry with the same id and the result of [transform] for the value. */
    public inline fun <R> mapValue(transform: (T) -> R): FieldEntry<ID, R> = FieldEntry(id, transform(value))
}

/** The entry for this pair's device and value. */
public fun <ID : Any, T> Pair<ID, T>.toFieldEntry(): FieldEntry<ID, T> = FieldEntry(this)

/** The entry for this map entry's key and value. */
public fun <ID : Any, T> Map.Entry<ID, T>.toFieldEntry(): FieldEntry<ID, T> = FieldEntry(this)
