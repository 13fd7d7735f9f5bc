package leaderelection

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.util.Point2D
import org.junit.jupiter.api.Test
import samples.Swarm
import java.nio.ByteBuffer
import java.nio.ByteOrder
import kotlin.test.assertEquals

/** Tests the leader election with values that are calculated by hand. Nodes 0 to 5 are in a row, 10 m apart, each linked to the next. */
class LeaderElectionTest {
    private fun swarm(radius: String) =
        Swarm(11.0, mapOf("radius" to radius), { _, place -> sensors(place) }, Aggregate<Int>::leaderElection).apply {
            for (id in 0..5) places[id] = Point2D(10.0 * id to 0.0)
        }

    private fun Map<Int, ActuatorData>.leaders() = values.map { it.leader }

    @Test
    fun `the greatest id leads all within the radius, then the greatest of the others`() {
        swarm("20").use { assertEquals(listOf(2, 2, 2, 5, 5, 5), it.ticks(STABLE).leaders()) }
        swarm("10").use { assertEquals(listOf(1, 1, 3, 3, 5, 5), it.ticks(STABLE).leaders()) }
        swarm("50").use { assertEquals(listOf(5, 5, 5, 5, 5, 5), it.ticks(STABLE).leaders()) }
    }

    @Test
    fun `each node computes its distance to the nearest leader`() {
        val answers = swarm("20").use { it.ticks(STABLE) }
        assertEquals(listOf(20f, 10f, 0f, 10f, 10f, 0f), answers.values.map { it.distance })
    }

    @Test
    fun `when a leader fails, another one is elected`() = swarm("20").use {
        it.ticks(STABLE)
        it.places -= 5
        assertEquals(listOf(1, 1, 4, 4, 4), it.ticks(STABLE).leaders())
    }

    @Test
    fun `a single node leads itself`() = swarm("20").use {
        it.places -= 4
        val answers = it.ticks(STABLE)
        assertEquals(5, answers.getValue(5).leader)
        assertEquals(0f, answers.getValue(5).distance)
    }

    private fun sensors(place: Point2D): SensorData {
        val bytes = ByteBuffer.allocate(12).order(ByteOrder.LITTLE_ENDIAN)
        return SensorData().__assign(0, bytes.putFloat(place.x.toFloat()).putFloat(0f).putFloat(place.y.toFloat()))
    }

    private companion object {
        /** The number of ticks after which the answers no longer change. */
        const val STABLE = 40
    }
}
