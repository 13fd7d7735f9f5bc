package org.collektive.host.jfr

import jdk.jfr.FlightRecorder

/**
 * The reusable event objects of one session. The end event is created early, because memory may be exhausted at the end.
 *
 * Create them only if the flight recorder of this JVM is initialised: the first event takes about 80 ms, which would delay the first tick.
 */
internal class SessionEvents private constructor() {
    val tick = TickEvent()
    val network = NetworkStatsEvent()
    val end = SessionEndEvent()

    companion object {
        /** Whether this JVM records or has recorded. Cheap enough for each round. */
        val isRecorderInitialized: Boolean get() = FlightRecorder.isInitialized()

        /** Returns the events of a session, or `null` before the flight recorder is initialised. */
        fun ofRecorder(): SessionEvents? = if (isRecorderInitialized) SessionEvents() else null

        /** Preloads the event classes, so that the first recorded tick does not wait for them. */
        fun prepare() {
            SessionEvents()
            SessionStartEvent()
            ProgramRoundEvent()
            ProgramErrorEvent()
            SlotGrownEvent()
        }
    }
}
