package org.collektive.engine

import org.collektive.api.Device

/** A program that the engine runs. Called on many threads at once. */
public interface NodeProgram {
    /** The program's name in errors. */
    public val name: String

    /**
     * Runs one round of [device] and returns its answer; the engine counts `null` as a failure.
     *
     * @param aggregate the runtime's `Aggregate`, the receiver of the program.
     */
    public fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any?

    /** Describes [failure], which ended a round: what happened, then where. [place] is `null` when the runtime does not know it. */
    public fun describe(failure: Throwable, place: String?): String
}

/** A device during its round. */
public interface RoundDevice : Device {
    /** Number of values that the program has sent so far in this round. Walks all paths; avoid it in every round. */
    public val exports: Int
}
