package it.unibo.collektive.stdlib.util

import arrow.core.None
import arrow.core.Option
import arrow.core.Some
import kotlinx.serialization.Serializable

/**
 * An [Option] that can be serialised. Its value may be `null`.
 *
 * @property option the value, or [None].
 */
@JvmInline
@Serializable(with = MaybeSerializer::class)
public value class Maybe<out T> internal constructor(public val option: Option<T>) {
    public companion object {
        /** The absence of a value. */
        public val none: Maybe<Nothing> = Maybe(None)

        /** Returns a [Maybe] that contains [value]. */
        public fun <T> some(value: T): Maybe<T> = Maybe(Some(value))

        /** Returns this option as a [Maybe], which can be serialised. */
        public fun <T> Option<T>.serializable(): Maybe<T> = Maybe(this)

        /** Combines both values with [combiner]. If only one value is present, returns it unchanged. */
        public inline fun <T> Option<T>.merge(other: Option<T>, combiner: (T, T) -> T): Option<T> = when (this) {
            is None -> other

            is Some -> when (other) {
                is None -> this
                is Some -> Some(combiner(value, other.value))
            }
        }

        /** Combines both values with [combiner]. If only one value is present, returns it unchanged. */
        public inline fun <T> Maybe<T>.merge(other: Maybe<T>, combiner: (T, T) -> T): Maybe<T> =
            option.merge(other.option, combiner).serializable()
    }
}
