package it.unibo.collektive

import it.unibo.collektive.aggregate.AggregateResult
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.networking.Mailbox
import it.unibo.collektive.networking.NeighborsData
import it.unibo.collektive.networking.NoNeighborsData
import it.unibo.collektive.path.DigestHashingFactory
import it.unibo.collektive.path.FullPathFactory
import it.unibo.collektive.path.PathFactory
import it.unibo.collektive.state.State
import org.collektive.runtime.MailboxRound

/**
 * One device that runs [computeFunction] round by round and exchanges messages through a [Mailbox]. Confined to one thread at a time.
 *
 * The primitives behave as in simulations. A simulation is faster, because its devices read each other's messages in place.
 *
 * @property localId the device's id.
 */
public class Collektive<ID : Any, R>(
    public val localId: ID,
    private val network: Mailbox<ID>,
    private val pathFactory: PathFactory = pathsFor(network.inMemory),
    private val computeFunction: Aggregate<ID>.() -> R,
) {
    /** The state after the last round. */
    public var state: State = emptyMap()
        private set

    /** Runs one round, sends its messages and returns its result. When the program throws, state and messages do not change. */
    public fun cycle(): R = nextRound().result

    /** Runs rounds, at least one, as long as [condition] holds for the outcome of each. Returns the last result. */
    public fun cycleWhile(condition: (AggregateResult<ID, R>) -> Boolean): R {
        var round = nextRound()
        while (condition(round)) round = nextRound()
        return round.result
    }

    private fun nextRound(): AggregateResult<ID, R> =
        aggregate(localId, network, state, pathFactory, computeFunction).also { state = it.newState }

    public companion object {
        /**
         * Runs one round of [compute] without a network.
         *
         * @param previousState the state after the previous round.
         * @param inbound the neighbours' messages.
         * @param inMemory whether values stay in the process and need no serializer.
         */
        public fun <ID : Any, R> aggregate(
            localId: ID,
            previousState: State = emptyMap(),
            inbound: NeighborsData<ID> = NoNeighborsData(),
            inMemory: Boolean = inbound is NoNeighborsData,
            pathFactory: PathFactory = pathsFor(inMemory),
            compute: Aggregate<ID>.() -> R,
        ): AggregateResult<ID, R> = MailboxRound(localId, inMemory, pathFactory, previousState, inbound).run(compute)

        /** Runs one round of [compute] on the inbound messages of [network], and sends the round's messages through it. */
        public fun <ID : Any, R> aggregate(
            localId: ID,
            network: Mailbox<ID>,
            previousState: State = emptyMap(),
            pathFactory: PathFactory = pathsFor(network.inMemory),
            compute: Aggregate<ID>.() -> R,
        ): AggregateResult<ID, R> = aggregate(localId, previousState, network.currentInbound(), network.inMemory, pathFactory, compute)
            .also { network.deliverableFor(it.toSend) }

        private fun pathsFor(inMemory: Boolean): PathFactory = if (inMemory) FullPathFactory else DigestHashingFactory()
    }
}
