package it.unibo.collektive.networking

/** How one device reaches its neighbours: theirs to implement who bring a network. */
public interface Mailbox<ID : Any> {
    /** `true` when messages stay in the process, so that any object can be sent. */
    public val inMemory: Boolean

    /** Sends [outboundMessage], the device's latest, to its neighbours, in place of the former; called after each round. */
    public fun deliverableFor(outboundMessage: OutboundEnvelope<ID>)

    /** Takes in [message] from a neighbour, in place of its former one. */
    public fun deliverableReceived(message: Message<ID, *>)

    /** The neighbours' latest messages; asked once, before a round. */
    public fun currentInbound(): NeighborsData<ID>
}
