package org.collektive.runtime

/**
 * The messages of a device: [value] to the device [id], and [others] to all others.
 *
 * It replaces a field with the same value for all neighbours but one, as in gradient casts. A receiver then compares a single id instead
 * of searching the sender's ids.
 */
internal class AllButOne(val id: Any, val value: Any?, val others: Any?)
