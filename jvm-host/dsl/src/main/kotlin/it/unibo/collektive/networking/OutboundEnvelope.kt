package it.unibo.collektive.networking

import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.path.Path

/** All that a device sends after one round: for each path a value for each neighbour. */
public interface OutboundEnvelope<ID : Any> {
    /**
     * Adds what is sent at [path].
     *
     * @throws IllegalStateException when something is sent there already.
     */
    public fun <V> addData(path: Path, data: SharedData<ID, V>, dataSharingMethod: DataSharingMethod<V>)

    /** Whether nothing is sent. */
    public fun isEmpty(): Boolean

    /** Whether something is sent. */
    public fun isNotEmpty(): Boolean = !isEmpty()

    /** The message for [receiverId], in the form that [factory] gives it; one that was no neighbour in the round gets the defaults. */
    public fun prepareMessageFor(
        receiverId: ID,
        factory: MessageFactory<ID, *> = InMemoryMessageFactory(),
    ): Message<ID, Any?>

    /**
     * The values sent at one path.
     *
     * @property default for all that have no value in [overrides].
     */
    public data class SharedData<ID : Any, Value>(val default: Value, val overrides: Map<ID, Value> = emptyMap()) {
        /** The value for [receiverId]. */
        @Suppress("UNCHECKED_CAST")
        public operator fun get(receiverId: ID): Value =
            if (receiverId in overrides) overrides[receiverId] as Value else default
    }
}
