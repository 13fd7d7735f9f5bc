@file:CollektiveIgnore("aligns itself")
@file:OptIn(DelicateCollektiveApi::class)

package org.collektive.links

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.mapNeighborhood
import org.collektive.api.Device

/**
 * Returns the lengths of the links from the aligned neighbours in metres, and 0 for this device.
 *
 * The scene's neighbourhood rule sets the lengths, with the accuracy of its Length Tolerance, so programs need no positions in their
 * schema:
 *
 * ```
 * val toSource = with(device) { distanceTo(sensors.source(), metric = distances()) }
 * ```
 */
context(device: Device)
public fun Aggregate<Int>.distances(): Field<Int, Double> = ofLinks("distances", device::distance)

/** Returns the attenuations of the links from the aligned neighbours, and 0 for this device. The attenuation of a clear link is 0. */
context(device: Device)
public fun Aggregate<Int>.attenuations(): Field<Int, Double> = ofLinks("attenuations", device::attenuation)

private fun Aggregate<Int>.ofLinks(name: String, value: (Int) -> Double): Field<Int, Double> {
    align(name)
    try {
        return mapNeighborhood { if (it == localId) 0.0 else value(it) }
    } finally {
        dealign()
    }
}
