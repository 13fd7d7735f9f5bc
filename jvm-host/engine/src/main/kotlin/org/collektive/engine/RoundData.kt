package org.collektive.engine

/** What flows into and out of the rounds of a tick; opaque to the engine. [worker] is 0 until [EngineSettings.threads]. */
public interface RoundData {
    /** The sensors of the node `due[index]`, for use on the thread [worker] until its next call. */
    public fun sensors(worker: Int, index: Int): Any?

    /**
     * Packs the [answer] of the node `due[index]` on the thread [worker].
     *
     * @return why it cannot be packed, which makes the round a failed one; `null` when it was.
     */
    public fun pack(worker: Int, index: Int, answer: Any): String?
}
