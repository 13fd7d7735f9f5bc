package org.collektive.runtime

/**
 * The messages of a device: [value] to the device [id], and [others] to all others.
 *
 * Replaces a field that differs for one neighbour only, as in gradient casts. A receiver then compares one id instead of searching
 * the sender's ids.
 */
internal class AllButOne(val id: Any, val value: Any?, val others: Any?)
