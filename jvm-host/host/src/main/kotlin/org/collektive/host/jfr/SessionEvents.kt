package org.collektive.host.jfr

import jdk.jfr.FlightRecorder

/**
 * The events of one session: those of its ticks are used again, and that of its end is made early, as there may be no memory then.
 *
 * Events are made only once this JVM has a flight recorder: the first one takes some 80 ms, for which no first tick should wait.
 */
internal class SessionEvents private constructor() {
    val tick = TickEvent()
    val network = NetworkStatsEvent()
    val end = SessionEndEvent()

    companion object {
        /** Whether anybody records, or has recorded: a plain read, cheap enough for each round. */
        val wanted: Boolean get() = FlightRecorder.isInitialized()

        /** `null` while nobody wants them. */
        fun ofRecorder(): SessionEvents? = if (wanted) SessionEvents() else null

        /** Preloads JFR's event classes, so that no tick waits for them when a recording starts. */
        fun prepare() {
            SessionEvents()
            SessionStartEvent()
            ProgramRoundEvent()
            ProgramErrorEvent()
            SlotGrownEvent()
        }
    }
}
