package org.collektive.engine

import org.collektive.api.Parameters
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.RoundProgram
import kotlin.random.Random

/** One node of a session: its links, its device, and its program, ready to run. */
internal class Node(
    override val id: Int,
    val program: NodeProgram,
    override val parameters: Parameters,
    val runtime: DeviceRuntime,
    private val clock: Clock,
    seed: Long,
    isIdeal: Boolean,
) : Outbox(),
    RoundDevice,
    RoundProgram {
    /** The one object that stands for [id] wherever ids are objects. */
    val boxedId: Any = id
    val incoming = IncomingLinks(id, isIdeal, clock)
    val outgoing = Peers()

    /** Tick at which this node was last put in order, and its index among the due ones: see BreadthFirst. */
    var arrangedAt = 0L
    var dueIndex = -1

    /** Last validation that removes this node: see TickValidator. */
    var mark = 0L

    override val random: Random = Philox(seed, id, purpose = 0)
    override val time: Double get() = clock.time
    override val deltaTime: Double
        get() = if (sentAt == 0L || sentAt == clock.tick - 1) clock.deltaTime else clock.time - sentTime
    override val globals: Any? get() = clock.globals
    override val exports: Int get() = runtime.exports

    override fun run(aggregate: Any, sensors: Any?): Any? = program.round(aggregate, sensors, this)
}

/** What all nodes of a session see alike; changes between rounds only. */
internal class Clock {
    var tick = 0L
    var time = 0.0
    var deltaTime = 0.0
    var globals: Any? = null

    /** Rounds read what was sent before this tick: in sequence they see what others sent in their own. */
    var readsBefore = 0L
}
