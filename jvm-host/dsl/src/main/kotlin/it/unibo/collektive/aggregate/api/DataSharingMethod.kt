package it.unibo.collektive.aggregate.api

import kotlinx.serialization.KSerializer

/** How values of type [T] are sent between devices. */
public sealed interface DataSharingMethod<in T>

/** By reference, inside one process. A shared value must not change afterwards: all receivers share the same object. */
public data object InMemory : DataSharingMethod<Any?>

/**
 * As bytes or text.
 *
 * @property serializer encodes and decodes the values.
 */
@JvmInline
public value class Serialize<T>(public val serializer: KSerializer<T>) : DataSharingMethod<T>
