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
 * One device that runs [computeFunction] round by round, and reaches others through a [Mailbox]. One thread at a time.
 *
 * Runs the same primitives as simulations do, which are faster: they read messages in place.
 *
 * @property localId the device's id.
 */
public class Collektive<ID : Any, R>(
    public val localId: ID,
    private val network: Mailbox<ID>,
    private val pathFactory: PathFactory = pathsFor(network.inMemory),
    private val computeFunction: Aggregate<ID>.() -> R,
) {
    /** What the last round kept. */
    public var state: State = emptyMap()
        private set

    /** Runs one round and sends its messages. When the program throws, state and messages stay as they were. */
    public fun cycle(): R = nextRound().result

    /** Runs rounds until [condition] fails on one; at least one. Returns the last result. */
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
         * @param previousState what the former round kept.
         * @param inbound the neighbours' messages.
         * @param inMemory whether values stay in the process.
         */
        public fun <ID : Any, R> aggregate(
            localId: ID,
            previousState: State = emptyMap(),
            inbound: NeighborsData<ID> = NoNeighborsData(),
            inMemory: Boolean = inbound is NoNeighborsData,
            pathFactory: PathFactory = pathsFor(inMemory),
            compute: Aggregate<ID>.() -> R,
        ): AggregateResult<ID, R> = MailboxRound(localId, inMemory, pathFactory, previousState, inbound).run(compute)

        /** Runs one round of [compute] with what [network] holds, and gives it the new messages. */
        public fun <ID : Any, R> aggregate(
            localId: ID,
            network: Mailbox<ID>,
            previousState: State = emptyMap(),
            pathFactory: PathFactory = pathsFor(network.inMemory),
            compute: Aggregate<ID>.() -> R,
        ): AggregateResult<ID, R> =
            aggregate(localId, previousState, network.currentInbound(), network.inMemory, pathFactory, compute)
                .also { network.deliverableFor(it.toSend) }

        private fun pathsFor(inMemory: Boolean): PathFactory = if (inMemory) FullPathFactory else DigestHashingFactory
    }
}
