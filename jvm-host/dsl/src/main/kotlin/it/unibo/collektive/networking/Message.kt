package it.unibo.collektive.networking

import it.unibo.collektive.path.Path
import kotlinx.serialization.Serializable

/** The message from one device to one neighbour after a round. */
public sealed interface Message<ID : Any, out Payload> {
    /** The device that sent the message. */
    public val senderId: ID

    /** The value for the receiver at each path that the sender visited. */
    public val sharedData: Map<Path, Payload>
}

/** A message whose values are passed by reference. */
public data class InMemoryMessage<ID : Any>(override val senderId: ID, override val sharedData: Map<Path, Any?>) : Message<ID, Any?>

/**
 * A message whose values are serialised one by one, because a receiver knows the type of a value only when its program reaches the path.
 */
@Serializable
public data class SerializedMessage<ID : Any>(override val senderId: ID, override val sharedData: Map<Path, ByteArray>) :
    Message<ID, ByteArray>
