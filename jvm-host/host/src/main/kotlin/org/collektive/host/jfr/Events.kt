package org.collektive.host.jfr

import jdk.jfr.Category
import jdk.jfr.DataAmount
import jdk.jfr.Description
import jdk.jfr.Event
import jdk.jfr.Label
import jdk.jfr.Name
import jdk.jfr.StackTrace
import jdk.jfr.Timespan

/** Event of one tick, from the host call to its answer. Each session reuses one object. */
@Name("collektive.Tick")
@Label("Tick")
@Category("Collektive")
@StackTrace(false)
internal class TickEvent : Event() {
    @Label("Tick")
    @JvmField
    var tick = 0L

    @Label("Nodes")
    @JvmField
    var nodes = 0

    @Label("Due Nodes")
    @Description("Number of nodes that ran a round in this tick")
    @JvmField
    var dueNodes = 0

    @Label("Failed Rounds")
    @JvmField
    var failedRounds = 0

    @Label("Links")
    @Description("Number of directed links")
    @JvmField
    var links = 0

    @Label("Bytes In")
    @DataAmount
    @JvmField
    var bytesIn = 0L

    @Label("Bytes Out")
    @DataAmount
    @JvmField
    var bytesOut = 0L

    @Label("Wait")
    @Description("Time since the end of the previous tick: sensors, actuators, physics and rendering outside the JVM")
    @Timespan(Timespan.NANOSECONDS)
    @JvmField
    var wait = 0L

    @Label("Rounds")
    @Timespan(Timespan.NANOSECONDS)
    @JvmField
    var rounds = 0L

    @Label("Write")
    @Description("Time to write the answer and its digest")
    @Timespan(Timespan.NANOSECONDS)
    @JvmField
    var write = 0L
}

/** Event with the message counts of one tick. Each session reuses one object. */
@Name("collektive.NetworkStats")
@Label("Network Stats")
@Category("Collektive")
@StackTrace(false)
internal class NetworkStatsEvent : Event() {
    @Label("Tick")
    @JvmField
    var tick = 0L

    @Label("Sent")
    @Description("Number of messages sent, one per link and export")
    @JvmField
    var sent = 0L

    @Label("Dropped")
    @JvmField
    var dropped = 0L

    @Label("Delayed")
    @Description("Number of messages that arrive later than in an ideal network")
    @JvmField
    var delayed = 0L

    @Label("Expired")
    @Description("Number of received messages that expired")
    @JvmField
    var expired = 0L
}

/** Event of a program's sampled round, see [RoundSampling]. */
@Name("collektive.ProgramRound")
@Label("Program Round")
@Description("A sampled round: one in ${RoundSampling.INTERVAL} rounds of each thread")
@Category("Collektive")
@StackTrace(false)
internal class ProgramRoundEvent : Event() {
    @Label("Node")
    @JvmField
    var node = 0

    @Label("Program")
    @JvmField
    var program: String? = null

    @Label("Function")
    @Description("Class and method of the program")
    @JvmField
    var function: String? = null

    @Label("Exports")
    @Description("Number of values sent to the neighbours, one per aligned path")
    @JvmField
    var exports = 0
}

/** Event of an opened session; its duration is the time that opening took. */
@Name("collektive.SessionStart")
@Label("Session Start")
@Category("Collektive")
@StackTrace(false)
internal class SessionStartEvent : Event() {
    @Label("Programs")
    @JvmField
    var programs: String? = null

    @Label("Schema")
    @JvmField
    var schema: String? = null

    @Label("Schedule")
    @JvmField
    var schedule: String? = null

    @Label("Seed")
    @JvmField
    var seed = 0L

    @Label("Threads")
    @JvmField
    var threads = 0
}

/** Event of a closed session. */
@Name("collektive.SessionEnd")
@Label("Session End")
@Category("Collektive")
@StackTrace(false)
internal class SessionEndEvent : Event() {
    @Label("Ticks")
    @JvmField
    var ticks = 0L

    @Label("Failure")
    @Description("Reason for the failure; null if the session ended normally")
    @JvmField
    var failure: String? = null
}

/** Event of a failed round. */
@Name("collektive.ProgramError")
@Label("Program Error")
@Category("Collektive")
@StackTrace(false)
internal class ProgramErrorEvent : Event() {
    @Label("Tick")
    @JvmField
    var tick = 0L

    @Label("Node")
    @JvmField
    var node = 0

    @Label("Program")
    @JvmField
    var program: String? = null

    @Label("Message")
    @JvmField
    var message: String? = null
}

/** Event of an answer slot that was enlarged. */
@Name("collektive.SlotGrown")
@Label("Slot Grown")
@Category("Collektive")
@StackTrace(false)
internal class SlotGrownEvent : Event() {
    @Label("Before")
    @DataAmount
    @JvmField
    var before = 0L

    @Label("After")
    @DataAmount
    @JvmField
    var after = 0L
}
