package org.collektive.engine

/** Input and output of the rounds of a tick, opaque to the engine. `worker` is a thread's index, 0 until [EngineSettings.threads]. */
public interface RoundData {
    /** Returns the sensor data of the node `due[index]`. Valid on the thread [worker] until its next call. */
    public fun sensors(worker: Int, index: Int): Any?

    /**
     * Packs the [answer] of the node `due[index]` on the thread [worker].
     *
     * @return `null` on success, otherwise the reason of the failure, which fails the round.
     */
    public fun pack(worker: Int, index: Int, answer: Any): String?
}
