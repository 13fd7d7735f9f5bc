package org.collektive.engine

/** In which order rounds of one tick see each other. */
public enum class Schedule {
    /** All due nodes read what was sent before the tick; rounds run in parallel. */
    LOCKSTEP,

    /** Due nodes run in id order; each sees what earlier ones sent in the same tick. */
    SEQUENTIAL,

    /** Nodes are due at times of their own, which the caller knows; those due in one tick see what was sent before it. */
    ASYNCHRONOUS,
}

/**
 * How an engine runs.
 *
 * @property seed of all random numbers.
 * @property threads that run rounds, 1..256; results do not depend on it.
 */
public class EngineSettings(
    public val seed: Long,
    public val threads: Int = 1,
    public val schedule: Schedule = Schedule.LOCKSTEP,
    public val network: NetworkModel = NetworkModel(),
) {
    init {
        require(threads in 1..MAX_THREADS) { "threads must be 1..$MAX_THREADS, but is $threads" }
    }

    private companion object {
        const val MAX_THREADS = 256
    }
}
