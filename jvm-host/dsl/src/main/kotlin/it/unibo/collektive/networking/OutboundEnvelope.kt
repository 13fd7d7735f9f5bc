package it.unibo.collektive.networking

import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.path.Path

/** The values that a device sends after one round, one for each neighbour at each path. */
public interface OutboundEnvelope<ID : Any> {
    /**
     * Adds the values to send at [path].
     *
     * @throws IllegalStateException when [path] already has values.
     */
    public fun <V> addData(path: Path, data: SharedData<ID, V>, dataSharingMethod: DataSharingMethod<V>)

    /** Whether the device sends no values. */
    public fun isEmpty(): Boolean

    /** Whether the device sends values. */
    public fun isNotEmpty(): Boolean = !isEmpty()

    /**
     * Returns the message for [receiverId], created with [factory]. A receiver that was not a neighbour during the round gets the default
     * values.
     */
    public fun prepareMessageFor(receiverId: ID, factory: MessageFactory<ID, *> = InMemoryMessageFactory()): Message<ID, Any?>

    /**
     * The values to send at one path.
     *
     * @property default the value for receivers that are not in [overrides].
     */
    public data class SharedData<ID : Any, Value>(val default: Value, val overrides: Map<ID, Value> = emptyMap()) {
        /** The value for [receiverId]. */
        @Suppress("UNCHECKED_CAST")
        public operator fun get(receiverId: ID): Value = if (receiverId in overrides) overrides[receiverId] as Value else default
    }
}
