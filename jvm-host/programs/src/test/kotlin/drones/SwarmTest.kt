package drones

import com.google.flatbuffers.FlatBufferBuilder
import it.unibo.collektive.stdlib.util.Point3D
import org.collektive.schema.Vector3
import org.collektive.testing.TestNetwork
import org.junit.jupiter.api.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

/** Tests drones that stay where they are. */
class SwarmTest {
    private val places = sortedMapOf<Int, Point3D>()
    private val network = TestNetwork(deltaTime = 0.05)

    @Test
    fun `the greatest id leads, and each shape spreads one hop per round`() {
        line(10)
        // The drone with the greatest id leads from the start. In the first round, the others also consider themselves leaders.
        val shapes = List(12) { tick().values.map { it.shape } }
        assertEquals(List(10) { 0 }, shapes.last())
        assertEquals(listOf(9), tick().filterValues { it.leads }.keys.toList())
        val later = List(12) { tick().values.map { it.shape } }
        val first = later.indexOfFirst { 1 in it }
        assertEquals(listOf(0, 0, 0, 0, 0, 0, 0, 0, 0, 1), later[first])
        assertEquals(listOf(0, 0, 0, 0, 0, 0, 0, 0, 1, 1), later[first + 1])
    }

    @Test
    fun `if the leader fails, another one selects the next shape`() {
        line(6)
        repeat(10) { tick() }
        network.remove(5)
        places.remove(5)
        val answers = List(MANY) { tick() }
        assertEquals(listOf(4), answers.last().filterValues { it.leads }.keys.toList())
        assertTrue(answers.last().values.all { it.shape == answers.last().getValue(4).shape })
    }

    @Test
    fun `a drone flies to the shape, and away from a drone that is too near`() {
        add(0, Point3D(Triple(0.0, 0.0, 0.0)))
        add(1, Point3D(Triple(0.5, 0.0, 0.0)))
        network.link(0, 1)
        repeat(3) { tick() }
        val (left, right) = tick().values.map { it.target }
        assertTrue(right.x - left.x > 4, "$left $right")
        assertTrue(left.y > 5 && right.y > 5, "they must rise, because the sphere is above them: $left $right")
    }

    @Test
    fun `a drone without a position fails with a message that says so`() {
        network.add(0, parameters = PARAMETERS)
        val error = assertFailsWith<IllegalStateException> { network.round { swarm(sensors(null), it) } }
        assertContains(error.message.orEmpty(), "the sensor data has no position")
    }

    private fun line(count: Int) {
        for (id in 0 until count) {
            add(id, Point3D(Triple(2.0 * id, 0.0, 0.0)))
            if (id > 0) network.link(id - 1, id)
        }
    }

    private fun add(id: Int, place: Point3D) {
        network.add(id, parameters = PARAMETERS)
        places[id] = place
    }

    private fun tick(): Map<Int, ActuatorData> = network.round { swarm(sensors(places.getValue(it.id)), it) }

    private fun sensors(place: Point3D?): SensorData {
        val builder = FlatBufferBuilder()
        SensorData.startSensorData(builder)
        place?.let { SensorData.addPosition(builder, Vector3.createVector3(builder, it.x.toFloat(), it.y.toFloat(), it.z.toFloat())) }
        builder.finish(SensorData.endSensorData(builder))
        return SensorData.getRootAsSensorData(builder.dataBuffer())
    }

    private companion object {
        const val MANY = 160
        val PARAMETERS = mapOf("radius" to "20.0", "shapeSeconds" to "1.0", "speed" to "12.0")
    }
}
