package it.unibo.collektive.networking

import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.path.Path

/** The latest messages of a device's neighbours. Must not change while a round runs. */
public interface NeighborsData<ID : Any> {
    /** The ids of the neighbours, without the device's own. */
    public val neighbors: Set<ID>

    /**
     * The values that neighbours sent at [path]: one entry per neighbour whose message has that path, even if the value is `null`.
     *
     * @param dataSharingMethod how to read serialised values.
     */
    public fun <Value> dataAt(path: Path, dataSharingMethod: DataSharingMethod<Value>): Map<ID, Value>
}

/** No neighbours. */
public class NoNeighborsData<ID : Any> : NeighborsData<ID> {
    override val neighbors: Set<ID> get() = emptySet()

    override fun <Value> dataAt(path: Path, dataSharingMethod: DataSharingMethod<Value>): Map<ID, Value> = emptyMap()
}
