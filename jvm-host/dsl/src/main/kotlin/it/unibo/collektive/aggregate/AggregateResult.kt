package it.unibo.collektive.aggregate

import it.unibo.collektive.networking.OutboundEnvelope
import it.unibo.collektive.state.State

/**
 * The outcome of one round.
 *
 * @property localId the device that ran the round.
 * @property result the value that the program returned.
 * @property toSend the messages for the neighbours.
 * @property newState the state for the next round.
 */
public data class AggregateResult<ID : Any, out R>(val localId: ID, val result: R, val toSend: OutboundEnvelope<ID>, val newState: State)
