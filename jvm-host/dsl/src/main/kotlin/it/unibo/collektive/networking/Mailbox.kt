package it.unibo.collektive.networking

/** Connects one device to its neighbours. Implement it to run programs on your own network. */
public interface Mailbox<ID : Any> {
    /** `true` when messages stay in the process, so that any object can be sent without a serializer. */
    public val inMemory: Boolean

    /** Sends [outboundMessage] to the device's neighbours, in place of the previous message. Called after each round. */
    public fun deliverableFor(outboundMessage: OutboundEnvelope<ID>)

    /** Stores [message] from a neighbour, in place of that neighbour's previous message. */
    public fun deliverableReceived(message: Message<ID, *>)

    /** Returns the neighbours' latest messages. Called once, before a round. */
    public fun currentInbound(): NeighborsData<ID>
}
