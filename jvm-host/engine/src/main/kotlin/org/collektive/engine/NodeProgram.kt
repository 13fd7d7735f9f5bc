package org.collektive.engine

import org.collektive.api.Device
import org.collektive.spi.RoundProgram

/** A program that the engine runs. Called on many threads at once. */
public interface NodeProgram {
    /** The program's name in errors. */
    public val name: String

    /**
     * Binds this program to one node. The runtime calls the result directly, with the node's sensors; it returns the node's answer, and
     * the engine counts `null` as a failure.
     *
     * @param device the node's device, for use during its rounds.
     */
    public fun on(device: RoundDevice): RoundProgram

    /** Describes [failure], which ended a round: what happened, then where. [place] is `null` when the runtime does not know it. */
    public fun describe(failure: Throwable, place: String?): String
}

/** A device during its round. */
public interface RoundDevice : Device {
    /** Number of values that the program has sent so far in this round. Walks all paths; avoid it in every round. */
    public val exports: Int
}
