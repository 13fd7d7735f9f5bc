package org.collektive.engine

import org.collektive.api.Device

/** A program as the engine calls it. Threads: many at once. */
public interface NodeProgram {
    /** Its name in errors. */
    public val name: String

    /** Runs one round of [device] and returns its answer, never `null`; [aggregate] is the receiver that the device's runtime gives its programs. */
    public fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any?

    /** Text of the error [failure], which ended a round: what happened, then where; [place] when the runtime knows it. */
    public fun describe(failure: Throwable, place: String?): String
}

/** A device during its round. */
public interface RoundDevice : Device {
    /** Number of values that the program has sent so far in this round. Walks all of them: not for every round. */
    public val exports: Int
}
