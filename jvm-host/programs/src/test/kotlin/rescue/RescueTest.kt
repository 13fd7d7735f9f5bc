package rescue

import com.google.flatbuffers.FlatBufferBuilder
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.util.Point2D
import org.collektive.schema.Vector3
import org.junit.jupiter.api.Test
import samples.Swarm
import kotlin.math.hypot
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Tests robots in a row, 8 m apart, of which node 0 is the base. Robots within 9 m of each other are linked. */
class RescueTest {
    private val casualties = mutableMapOf<Int, Int>()
    private val obstacles = mutableMapOf<Int, Point2D>()

    private fun <T> robots(count: Int, use: (Swarm<SensorData, ActuatorData>) -> T): T = Swarm(
        9.0,
        mapOf("speed" to "2.5", "spacing" to "7.5", "casualties" to "2", "width" to "1.0"),
        ::sensors,
        Aggregate<Int>::rescue,
    ).use {
        for (id in 0 until count) it.places[id] = Point2D(8.0 * id to 0.0)
        use(it)
    }

    private fun Map<Int, ActuatorData>.roles() = values.map { it.role }

    @Test
    fun `without a casualty all robots explore and compute their distance to the base`() = robots(4) {
        val answers = it.ticks(STABLE)
        assertEquals(listOf(3, 0, 0, 0), answers.roles())
        assertEquals(listOf(0f, 8f, 16f, 24f), answers.values.map(ActuatorData::distance))
    }

    @Test
    fun `robots between a casualty and the base form a channel and keep their positions`() = robots(5) {
        casualties[3] = 1
        val answers = it.ticks(STABLE)
        assertEquals(listOf(3, 1, 1, 2, 0), answers.roles())
        for (id in 0..3) assertEquals(0f, answers.getValue(id).speed(), "node $id")
        assertTrue(answers.getValue(4).speed() > 0)
    }

    @Test
    fun `among robots that see a casualty the least id stays, and another replaces it when it fails`() = robots(4) {
        casualties += mapOf(2 to 0, 3 to 0)
        assertEquals(listOf(3, 1, 2, 0), it.ticks(STABLE).roles())
        it.places[1] = Point2D(16.0 to 1.0)
        it.places[4] = Point2D(8.0 to 1.0)
        it.places -= 2
        assertEquals(mapOf(0 to 3, 1 to 1, 3 to 2, 4 to 1), it.ticks(STABLE).mapValues { (_, answer) -> answer.role })
    }

    @Test
    fun `each casualty has its own channel, even behind a nearer one`() = robots(6) {
        casualties += mapOf(1 to 0, 5 to 1)
        assertEquals(listOf(3, 2, 1, 1, 1, 2), it.ticks(STABLE).roles())
    }

    @Test
    fun `a channel ends with its casualty`() = robots(4) {
        casualties[3] = 0
        it.ticks(STABLE)
        casualties.clear()
        assertEquals(listOf(3, 0, 0, 0), it.ticks(STABLE).roles())
    }

    @Test
    fun `a robot cut off from the base has no distance`() = robots(4) {
        it.ticks(STABLE)
        it.places -= 1
        assertEquals(listOf(0f, -1f, -1f), it.ticks(STABLE).values.map(ActuatorData::distance))
    }

    @Test
    fun `a robot gives way to a wall beside it, even in a channel`() = robots(3) {
        casualties[2] = 0
        obstacles[1] = Point2D(0.0 to 0.5)
        val velocity = it.ticks(STABLE).getValue(1).velocity
        assertEquals(0f, velocity.x)
        assertTrue(velocity.z < 0, "${velocity.z}")
    }

    private fun ActuatorData.speed() = hypot(velocity.x, velocity.z)

    private fun FlatBufferBuilder.vector(point: Point2D) = Vector3.createVector3(this, point.x.toFloat(), 0f, point.y.toFloat())

    private fun sensors(id: Int, place: Point2D): SensorData {
        val builder = FlatBufferBuilder()
        val near = listOfNotNull(obstacles[id])
        SensorData.startObstaclesVector(builder, near.size)
        near.forEach { builder.vector(it) }
        val found = builder.endVector()
        SensorData.startSensorData(builder)
        SensorData.addPosition(builder, builder.vector(place))
        SensorData.addObstacles(builder, found)
        SensorData.addBase(builder, id == 0)
        casualties[id]?.let { SensorData.addCasualty(builder, it) }
        builder.finish(SensorData.endSensorData(builder))
        return SensorData.getRootAsSensorData(builder.dataBuffer())
    }

    private companion object {
        /** The number of ticks after which the answers no longer change. */
        const val STABLE = 40
    }
}
