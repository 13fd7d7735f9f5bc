package it.unibo.collektive.aggregate.api

/** How values of type [T] travel between devices. */
public sealed interface DataSharingMethod<in T>

/** By reference, inside one process: a shared value must not change afterwards. */
public data object InMemory : DataSharingMethod<Any?>
