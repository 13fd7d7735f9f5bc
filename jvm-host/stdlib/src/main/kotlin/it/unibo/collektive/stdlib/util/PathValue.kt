package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable

/**
 * What a device offers its neighbours in a gradient cast: [data], at a [distance] from its source.
 *
 * @property distance the accumulated distance from the source to the device that offers.
 * @property data the source's data as it arrived there.
 */
@Serializable
public class PathValue<ID : Any, D : Comparable<D>, T> @PublishedApi internal constructor(
    public val distance: D,
    public val data: T,
    internal val path: HopPath<ID>,
) : Comparable<PathValue<ID, D, T>> {
    /** The devices that the data came through: the source first, the one that offers not among them. */
    public val hops: List<ID> get() = path.toList()

    /** Nearer is less. */
    override fun compareTo(other: PathValue<ID, D, T>): Int = distance.compareTo(other.distance)

    override fun equals(other: Any?): Boolean =
        this === other || other is PathValue<*, *, *> && distance == other.distance && data == other.data && path == other.path

    override fun hashCode(): Int = (distance.hashCode() * 31 + data.hashCode()) * 31 + path.hashCode()

    override fun toString(): String = "PathValue(distance=$distance, data=$data, hops=$path)"
}
