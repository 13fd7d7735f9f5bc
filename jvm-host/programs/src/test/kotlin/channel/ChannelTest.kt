package channel

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.util.Point2D
import org.junit.jupiter.api.Test
import samples.Swarm
import java.nio.ByteBuffer
import java.nio.ByteOrder
import kotlin.test.assertEquals

/**
 * Tests the channel with values that are calculated by hand.
 *
 * Nodes 0 to 4 are in a row, 10 m apart. Node 0 is the source and node 4 the target. Node 5 is 8 m beside node 2, and node 6 is almost
 * between nodes 0 and 2. The path through node 6 is 40.1 m long, and the path through node 5 is 56 m long.
 */
class ChannelTest {
    private val row = (0..4).associateWith { Point2D(10.0 * it to 0.0) } + mapOf(5 to Point2D(20.0 to 8.0), 6 to Point2D(10.0 to 1.0))

    private fun swarm(width: String = "2.0") =
        Swarm(11.0, mapOf("width" to width), { id, place -> sensors(place, id == 0, id == 4) }, Aggregate<Int>::channel).apply {
            places +=
                row
        }

    private fun Map<Int, ActuatorData>.marked() = filterValues { it.inChannel }.keys

    @Test
    fun `the channel contains the shortest path and the nodes close to it`() {
        swarm().use { assertEquals(setOf(0, 1, 2, 3, 4, 6), it.ticks(STABLE).marked()) }
    }

    @Test
    fun `the channel's width is a parameter`() {
        swarm("0").use { assertEquals(setOf(0, 1, 2, 3, 4), it.ticks(STABLE).marked()) }
        swarm("16.1").use { assertEquals(row.keys, it.ticks(STABLE).marked()) }
    }

    @Test
    fun `rounding errors do not remove nodes from a channel without width`() = swarm("0").use {
        it.places.clear()
        for (id in 0..4) it.places[id] = Point2D(7.3 * id to 3.1 * id)
        assertEquals((0..4).toSet(), it.ticks(STABLE).marked())
    }

    @Test
    fun `each node computes its distance to the source`() {
        val answers = swarm().use { it.ticks(STABLE) }
        for ((id, metres) in listOf(
            0f,
            10f,
            20f,
            30f,
            40f,
            28f,
        ).withIndex()) {
            assertEquals(metres, answers.getValue(id).distance, 1e-4f, "node $id")
        }
    }

    @Test
    fun `when a node of the channel fails, the channel takes another path`() = swarm().use {
        it.ticks(STABLE)
        it.places -= 1
        assertEquals(setOf(0, 2, 3, 4, 6), it.ticks(STABLE).marked())
    }

    @Test
    fun `without a path there is no channel, and no distance beyond the gap`() = swarm().use {
        it.ticks(STABLE)
        it.places -= 3
        val answers = it.ticks(STABLE)
        assertEquals(emptySet(), answers.marked())
        assertEquals(-1f, answers.getValue(4).distance)
        assertEquals(20f, answers.getValue(2).distance)
    }

    @Test
    fun `a single node that is source and target is the channel`() =
        Swarm(1.0, mapOf("width" to "0"), { _, place -> sensors(place, source = true, target = true) }, Aggregate<Int>::channel).use {
            it.places[0] = Point2D(0.0 to 0.0)
            assertEquals(setOf(0), it.tick().marked())
        }

    private fun sensors(place: Point2D, source: Boolean, target: Boolean): SensorData {
        val bytes = ByteBuffer.allocate(16).order(ByteOrder.LITTLE_ENDIAN)
        bytes.putFloat(place.x.toFloat()).putFloat(0f).putFloat(place.y.toFloat()).put(if (source) 1 else 0).put(if (target) 1 else 0)
        return SensorData().__assign(0, bytes)
    }

    private companion object {
        /** The number of ticks after which the answers no longer change. */
        const val STABLE = 30
    }
}
