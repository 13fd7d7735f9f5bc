package it.unibo.collektive.networking

import it.unibo.collektive.path.Path
import kotlinx.serialization.Serializable

/** What one device sends one neighbour after a round. */
public sealed interface Message<ID : Any, out Payload> {
    /** The device that sent it. */
    public val senderId: ID

    /** For each path that the sender visited, the value for the receiver. */
    public val sharedData: Map<Path, Payload>
}

/** A message whose values are passed by reference. */
public data class InMemoryMessage<ID : Any>(
    override val senderId: ID,
    override val sharedData: Map<Path, Any?>,
) : Message<ID, Any?>

/** A message whose values are serialised one by one, as receivers learn their types only when their programs come to the paths. */
@Serializable
public data class SerializedMessage<ID : Any>(
    override val senderId: ID,
    override val sharedData: Map<Path, ByteArray>,
) : Message<ID, ByteArray>
