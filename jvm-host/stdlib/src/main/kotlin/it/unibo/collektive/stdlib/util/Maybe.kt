package it.unibo.collektive.stdlib.util

/** A value or none, where `null` is a value like others. */
public sealed interface Maybe<out T> {
    /** A [value]. */
    public data class Some<out T>(public val value: T) : Maybe<T>

    /** No value. */
    public data object None : Maybe<Nothing>
}
