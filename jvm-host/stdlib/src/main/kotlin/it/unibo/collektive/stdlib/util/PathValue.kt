package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable
import kotlinx.serialization.Transient

/**
 * A device's offer to its neighbours in a gradient cast.
 *
 * @property distance the accumulated distance from the source to the offering device.
 * @property data the source's data as it arrived at the offering device.
 * @property hops the devices that the data passed, beginning with the source and without the offering device.
 */
@Serializable
public data class PathValue<ID : Any, Value, Distance : Comparable<Distance>>(
    public val distance: Distance,
    public val data: Value,
    public val hops: List<ID> = emptyList(),
) : Comparable<PathValue<ID, Value, Distance>> {
    @Transient
    @kotlin.jvm.Transient // MessageSize does not count transient fields.
    internal val path: HopPath<ID> = hops as? HopPath<ID> ?: HopPath.of(hops)

    /** The number of hops from the source to the offering device. */
    public val length: Int get() = hops.size

    /** The source of the data. The offer of the source itself has no hops, and throws [NoSuchElementException]. */
    public val source: ID get() = hops.first()

    /** The device that sent the data to the offering device. The offer of the source itself throws [NoSuchElementException]. */
    public val nextHop: ID get() = hops.last()

    /** Returns whether the data passed through the device [id]. */
    public operator fun contains(id: ID): Boolean = id in path

    /** Returns this offer as it arrives from [neighbor], with the distance [distanceToNeighbor] limited to [bottom]..[top]. */
    public inline fun update(
        neighbor: ID,
        distanceToNeighbor: Distance,
        bottom: Distance,
        top: Distance,
        accumulateDistance: Reducer<Distance>,
        accumulateData: (Distance, Distance, Value) -> Value,
    ): PathValue<ID, Value, Distance> {
        val step = distanceToNeighbor.coerceIn(bottom, top)
        val total = accumulateDistance(distance, step).coerceIn(bottom, top)
        return PathValue(total, accumulateData(distance, step, data), hops + neighbor)
    }

    /** Compares the distances of the offers. */
    override fun compareTo(other: PathValue<ID, Value, Distance>): Int = distance.compareTo(other.distance)
}
