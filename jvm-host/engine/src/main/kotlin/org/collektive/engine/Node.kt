package org.collektive.engine

import org.collektive.api.Parameters
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.RoundProgram
import kotlin.random.Random

/** One node of a session: its links, its device and its program. */
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
    /** [id], boxed once. */
    val boxedId: Any = id
    val incoming = IncomingLinks(id, isIdeal, clock)
    val outgoing = Peers()

    /** Tick at which this node was last put in order, and its index among the due nodes. Used by [BreadthFirst]. */
    var arrangedAt = 0L
    var dueIndex = -1

    /** Number of the last validation that removes this node. Used by [TickValidator]. */
    var mark = 0L

    override val random: Random = Philox(seed, id, purpose = 0)
    override val time: Double get() = clock.time
    override val deltaTime: Double
        get() = if (sentAt == 0L || sentAt == clock.tick - 1) clock.deltaTime else clock.time - sentTime
    override val globals: Any? get() = clock.globals
    override val exports: Int get() = runtime.exports

    override fun distance(neighbor: Int): Double = incoming.indexOf(neighbor).let {
        if (it < 0) super.distance(neighbor) else incoming.length(it).toDouble()
    }

    override fun attenuation(neighbor: Int): Double = incoming.indexOf(neighbor).let {
        if (it < 0) super.attenuation(neighbor) else incoming.attenuation(it).toDouble()
    }

    override fun run(aggregate: Any, sensors: Any?): Any? = program.round(aggregate, sensors, this)
}

/** State that all nodes of a session share. Changes only between rounds. */
internal class Clock {
    var tick = 0L
    var time = 0.0
    var deltaTime = 0.0
    var globals: Any? = null

    /** Rounds read exports from before this tick; under the sequential schedule it is the next tick, so that they see the current one's. */
    var readsBefore = 0L
}
