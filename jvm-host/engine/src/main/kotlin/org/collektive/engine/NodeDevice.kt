package org.collektive.engine

import org.collektive.api.Parameters
import kotlin.random.Random

/** The [node] as a device, for its program. */
internal class NodeDevice(private val node: Node, override var parameters: Parameters, private val clock: Clock, seed: Long) : RoundDevice {
    override val id: Int get() = node.id
    override val random: Random = Philox(seed, node.id, purpose = 0)
    override val time: Double get() = clock.time
    override val deltaTime: Double
        get() = if (node.sentAt == 0L || node.sentAt == clock.tick - 1) clock.deltaTime else clock.time - node.sentTime
    override val globals: Any? get() = clock.globals
    override val exports: Int get() = node.runtime.exports

    override fun distance(neighbor: Int): Double = node.incoming.indexOf(neighbor).let {
        if (it < 0) super.distance(neighbor) else node.incoming.length(it).toDouble()
    }

    override fun attenuation(neighbor: Int): Double = node.incoming.indexOf(neighbor).let {
        if (it < 0) super.attenuation(neighbor) else node.incoming.attenuation(it).toDouble()
    }
}
