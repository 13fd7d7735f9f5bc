package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable

/**
 * A device's offer to its neighbours in a gradient cast: [data], at a [distance] from its source.
 *
 * @property distance the accumulated distance from the source to the offering device.
 * @property data the source's data as it arrived at the offering device.
 */
@Serializable
public class PathValue<ID : Any, D : Comparable<D>, T> @PublishedApi internal constructor(
    public val distance: D,
    public val data: T,
    internal val path: HopPath<ID>,
) : Comparable<PathValue<ID, D, T>> {
    /** The devices that the data passed, the source first, without the offering device. */
    public val hops: List<ID> get() = path.toList()

    /** The nearer offer is less. */
    override fun compareTo(other: PathValue<ID, D, T>): Int = distance.compareTo(other.distance)

    override fun equals(other: Any?): Boolean =
        this === other || other is PathValue<*, *, *> && distance == other.distance && data == other.data && path == other.path

    override fun hashCode(): Int = (distance.hashCode() * 31 + data.hashCode()) * 31 + path.hashCode()

    override fun toString(): String = "PathValue(distance=$distance, data=$data, hops=$path)"
}
