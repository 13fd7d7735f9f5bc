package it.unibo.collektive.aggregate.api

import kotlinx.serialization.KSerializer

/** How values of type [T] travel between devices. */
public sealed interface DataSharingMethod<in T>

/** By reference, inside one process: a shared value must not change afterwards. */
public data object InMemory : DataSharingMethod<Any?>

/**
 * As written and read by [serializer].
 *
 * @property serializer writes and reads the values.
 */
public data class Serialize<T>(public val serializer: KSerializer<T>) : DataSharingMethod<T>
