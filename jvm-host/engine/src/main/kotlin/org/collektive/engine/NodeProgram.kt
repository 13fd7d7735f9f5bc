package org.collektive.engine

import org.collektive.api.Device

/** A program that the engine runs. Called concurrently on several threads. */
public interface NodeProgram {
    /** The program's name in error messages. */
    public val name: String

    /**
     * Runs one round of [device] and returns its answer; `null` fails the round.
     *
     * @param aggregate the runtime's `Aggregate`, the receiver of the program.
     */
    public fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any?

    /** Describes the [failure] of a round: what happened, then where. [place] is `null` if the runtime does not know it. */
    public fun describe(failure: Throwable, place: String?): String
}

/** A device during its round. */
public interface RoundDevice : Device {
    /** Number of values that the program has sent so far in this round. Expensive: walks all paths. */
    public val exports: Int
}
