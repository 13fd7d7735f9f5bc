package org.collektive.host.jfr

import jdk.jfr.Category
import jdk.jfr.DataAmount
import jdk.jfr.Description
import jdk.jfr.Event
import jdk.jfr.Label
import jdk.jfr.Name
import jdk.jfr.StackTrace
import jdk.jfr.Timespan

/** One tick, from the host call to its answer. Each session reuses one object. */
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
    @Description("Nodes that ran a round in this tick")
    @JvmField
    var dueNodes = 0

    @Label("Failed Rounds")
    @JvmField
    var failedRounds = 0

    @Label("Links")
    @Description("Directed links")
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
    @Description("Building the answer and its digest")
    @Timespan(Timespan.NANOSECONDS)
    @JvmField
    var write = 0L
}

/** The messages of one tick. Each session reuses one object. */
@Name("collektive.NetworkStats")
@Label("Network Stats")
@Category("Collektive")
@StackTrace(false)
internal class NetworkStatsEvent : Event() {
    @Label("Tick")
    @JvmField
    var tick = 0L

    @Label("Sent")
    @Description("Messages sent, one per link and export")
    @JvmField
    var sent = 0L

    @Label("Dropped")
    @JvmField
    var dropped = 0L

    @Label("Delayed")
    @Description("Messages that arrive later than in an ideal network")
    @JvmField
    var delayed = 0L

    @Label("Expired")
    @Description("Received messages that expired")
    @JvmField
    var expired = 0L
}

/** The run of a program in a sampled round, see [ProgramRounds]. */
@Name("collektive.ProgramRound")
@Label("Program Round")
@Description("One in ${ProgramRounds.EVERY} rounds of each thread")
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
    @Description("Values sent to the neighbours, one per place in the program")
    @JvmField
    var exports = 0
}

/** A session was opened; the event lasts as long as the opening. */
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

/** A session was closed. */
@Name("collektive.SessionEnd")
@Label("Session End")
@Category("Collektive")
@StackTrace(false)
internal class SessionEndEvent : Event() {
    @Label("Ticks")
    @JvmField
    var ticks = 0L

    @Label("Failure")
    @Description("Why the session ended early")
    @JvmField
    var failure: String? = null
}

/** A round failed. */
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

/** An answer outgrew its slot. */
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
