package org.collektive.host.jfr

import jdk.jfr.FlightRecorder

/**
 * The event objects of one session. The tick's events are reused; the end's is made early, because memory may be exhausted by then.
 *
 * Make them only once this JVM has a flight recorder: the first event takes some 80 ms, which would delay the first tick.
 */
internal class SessionEvents private constructor() {
    val tick = TickEvent()
    val network = NetworkStatsEvent()
    val end = SessionEndEvent()

    companion object {
        /** Whether this JVM records or has recorded. A plain read, cheap enough for each round. */
        val wanted: Boolean get() = FlightRecorder.isInitialized()

        /** The events of a session; `null` while they are not [wanted]. */
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
