package org.collektive.engine

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.impl.ProgramPlace
import org.collektive.api.Device

/** A program as the engine calls it; used by many threads at once. */
public interface NodeProgram {
    /** What errors call it. */
    public val name: String

    /** Runs one round of [device] on [sensors]; the result must not be `null`. */
    public fun round(aggregate: Aggregate<Int>, sensors: Any?, device: Device): Any?

    /** The text of an error by which a round failed: what happened, then where; [place] when the runtime knows it. */
    public fun describe(failure: Throwable, place: ProgramPlace?): String
}

/** The data that flows into and out of the rounds of a tick; opaque to the engine. */
public interface RoundData {
    /** The sensors of the node `due[index]`, for use on the thread [worker] (0 until [EngineSettings.threads]) until its next call. */
    public fun sensors(worker: Int, index: Int): Any?

    /** Why [answer] of the node `due[index]` is of no use, which makes its round a failed one; `null` when nothing is wrong. Called on the thread [worker]. */
    public fun fault(worker: Int, index: Int, answer: Any): String?
}
