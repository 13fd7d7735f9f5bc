package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable

/** An optional value that may itself be `null`. */
@Serializable(with = MaybeSerializer::class)
public sealed interface Maybe<out T> {
    /** The [value] is present. */
    public data class Some<out T>(public val value: T) : Maybe<T>

    /** No value. */
    public data object None : Maybe<Nothing>
}
