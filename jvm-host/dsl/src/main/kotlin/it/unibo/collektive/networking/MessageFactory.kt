package it.unibo.collektive.networking

import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.path.Path

/** Creates messages of one kind. */
public interface MessageFactory<ID : Any, out Payload> {
    /** The message of [senderId] with [sharedData]. */
    public operator fun invoke(senderId: ID, sharedData: Map<Path, PayloadRepresentation<Any?>>): Message<ID, Payload>
}

/**
 * A value to send.
 *
 * @property payload the value.
 * @property representation how the value is sent.
 */
public data class PayloadRepresentation<P>(val payload: P, val representation: DataSharingMethod<P>)

/** Creates [InMemoryMessage]s. */
public class InMemoryMessageFactory<ID : Any> : MessageFactory<ID, Any?> {
    override fun invoke(senderId: ID, sharedData: Map<Path, PayloadRepresentation<Any?>>): Message<ID, Any?> =
        InMemoryMessage(senderId, sharedData.mapValues { it.value.payload })
}
