package org.collektive.engine

/** Determines which messages the rounds of a tick read. */
public enum class Schedule {
    /** All due nodes read the messages of earlier ticks; their rounds run in parallel. */
    LOCKSTEP,

    /** Due nodes run in id order; each also reads the messages that earlier nodes sent in the same tick. */
    SEQUENTIAL,

    /** The caller schedules each node individually; the nodes due in one tick behave as under [LOCKSTEP]. */
    ASYNCHRONOUS,
}

/**
 * Settings of an [Engine].
 *
 * @property seed the seed of all random numbers.
 * @property threads the number of threads that run rounds, 1..256; results do not depend on it.
 * @property schedule which messages the rounds of a tick read.
 * @property network the network model; ideal by default.
 * @property keepsAnswers whether nodes keep their last answer for [Engine.snapshot].
 */
public class EngineSettings(
    public val seed: Long,
    public val threads: Int = 1,
    public val schedule: Schedule = Schedule.LOCKSTEP,
    public val network: NetworkModel = NetworkModel(),
    public val keepsAnswers: Boolean = false,
) {
    init {
        require(threads in 1..MAX_THREADS) { "the number of threads must be 1..$MAX_THREADS, but is $threads" }
    }

    private companion object {
        const val MAX_THREADS = 256
    }
}
