package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable

/** A value or none, where `null` is a value like others. */
@Serializable(with = MaybeSerializer::class)
public sealed interface Maybe<out T> {
    /** A [value]. */
    public data class Some<out T>(public val value: T) : Maybe<T>

    /** No value. */
    public data object None : Maybe<Nothing>
}
