package org.collektive.runtime

/**
 * What a device sent: [value] to the device [id], and [others] to all others.
 *
 * Stands for a field that differs for one neighbour only, as those of gradient casts do: a receiver compares one id instead of
 * searching the sender's.
 */
internal class AllButOne(val id: Any, val value: Any?, val others: Any?)
