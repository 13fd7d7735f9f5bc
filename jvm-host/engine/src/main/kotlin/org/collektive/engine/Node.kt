package org.collektive.engine

import org.collektive.spi.DeviceRuntime
import org.collektive.spi.RoundProgram

/** One node of a session: its links, its exports, its program and the runtime that runs it. */
internal class Node(new: NewNode, val runtime: DeviceRuntime, clock: Clock, seed: Long, isIdeal: Boolean) : Outbox() {
    val id = new.id

    var program = new.program
        private set

    /** See [NewNode.source]. */
    var source = new.source
        private set

    /** [id], boxed once. */
    val boxedId: Any = id
    val incoming = IncomingLinks(id, isIdeal, clock)
    val outgoing = NodeList()

    private val device = NodeDevice(this, new.parameters, clock, seed)
    private val roundProgram = RoundProgram { aggregate, sensors -> program.round(aggregate, sensors, device) }

    /** The last answer, if [EngineSettings.keepsAnswers]. */
    var answer: Any? = null

    /** The tick in which this node was last ordered, and its index among the due nodes. Used by [RoundOrder]. */
    var orderedAt = 0L
    var dueIndex = -1

    /** Number of the last validation that removes this node. Used by [TickValidator]. */
    var mark = 0L

    /** Whether the node has a new program that has not run a round yet. */
    var isReloaded = false
        private set

    /** Replaces the program and its parameters, and drops the answer, whose class the new program does not know. */
    fun reload(new: NewNode) {
        answer = null
        program = new.program
        device.parameters = new.parameters
        isReloaded = true
    }

    /** Replaces the parameters. */
    fun change(new: NewNode) {
        device.parameters = new.parameters
        source = new.source
    }

    /**
     * Ends the first round with a new program. If the round failed, the node starts afresh, because a value of the old program may not
     * fit the new one.
     */
    fun endFirstRound(hasFailed: Boolean) {
        isReloaded = false
        if (hasFailed) runtime.forget()
    }

    /** See [DeviceRuntime.round]. */
    fun round(sensors: Any?): Any? = runtime.round(incoming, roundProgram, sensors)
}

/** State that all nodes of a session share. Changes only between rounds. */
internal class Clock {
    var tick = 0L
    var time = 0.0
    var deltaTime = 0.0
    var globals: Any? = null

    /** Rounds read exports sent before this tick: the current tick, or the next one under the sequential schedule. */
    var readsBefore = 0L
}
