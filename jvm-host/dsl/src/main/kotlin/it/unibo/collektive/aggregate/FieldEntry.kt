package it.unibo.collektive.aggregate

/** The [value] that a [Field] has for the device [id]. */
public data class FieldEntry<out ID : Any, out T>(public val id: ID, public val value: T) {
    /** Returns an entry with the same id and the result of [transform] for this entry. */
    public inline fun <R> map(transform: (FieldEntry<ID, T>) -> R): FieldEntry<ID, R> = FieldEntry(id, transform(this))

    /** Returns an entry with the same id and the result of [transform] for the value. */
    public inline fun <R> mapValue(transform: (T) -> R): FieldEntry<ID, R> = FieldEntry(id, transform(value))
}
