package it.unibo.collektive.stdlib.util

import arrow.core.None
import arrow.core.Option
import arrow.core.Some
import kotlinx.serialization.Serializable

/**
 * An [Option] that can be serialised. Its value may be `null`.
 *
 * @property option the value, or none.
 */
@JvmInline
@Serializable(with = MaybeSerializer::class)
public value class Maybe<out T> internal constructor(public val option: Option<T>) {
    public companion object {
        /** No value. */
        public val none: Maybe<Nothing> = Maybe(None)

        /** The value [value]. */
        public fun <T> some(value: T): Maybe<T> = Maybe(Some(value))

        /** This option, so that it can be serialised. */
        public fun <T> Option<T>.serializable(): Maybe<T> = Maybe(this)

        /** Both values combined by [combiner], or the only one, or none. */
        public inline fun <T> Option<T>.merge(other: Option<T>, combiner: (T, T) -> T): Option<T> = when (this) {
            is None -> other

            is Some -> when (other) {
                is None -> this
                is Some -> Some(combiner(value, other.value))
            }
        }

        /** Both values combined by [combiner], or the only one, or none. */
        public inline fun <T> Maybe<T>.merge(other: Maybe<T>, combiner: (T, T) -> T): Maybe<T> =
            option.merge(other.option, combiner).serializable()
    }
}
