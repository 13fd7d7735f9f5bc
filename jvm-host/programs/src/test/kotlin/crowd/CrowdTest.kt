package crowd

import com.google.flatbuffers.FlatBufferBuilder
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.util.Point2D
import org.collektive.schema.Vector3
import org.collektive.schema.Vector3Value
import org.junit.jupiter.api.Test
import samples.Swarm
import kotlin.math.PI
import kotlin.math.hypot
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Tests walkers on the ground. Walkers within 6 m of each other are linked. */
class CrowdTest {
    private fun <T> walk(walkers: Map<Int, Walker>, use: (Swarm<SensorData, ActuatorData>) -> T): T =
        Swarm(6.0, mapOf("speed" to "1.4", "limit" to "0.9", "hops" to "2"), { id, place ->
            sensors(place, walkers.getValue(id))
        }, Aggregate<Int>::crowd).use {
            for ((id, walker) in walkers) it.places[id] = walker.place
            use(it)
        }

    private fun alone(goal: Point2D?, obstacle: Point2D? = null) =
        walk(mapOf(0 to Walker(Point2D(0.0 to 0.0), goal, listOfNotNull(obstacle)))) { it.tick().getValue(0).velocity }

    @Test
    fun `a free walker goes straight to its goal, and slows down in the last metre`() {
        assertEquals(0.84f to 1.12f, alone(Point2D(6.0 to 8.0)).onGround())
        assertEquals(0.7f to 0f, alone(Point2D(0.5 to 0.0)).onGround())
        assertEquals(0f to 0f, alone(Point2D(0.0 to 0.0)).onGround())
    }

    @Test
    fun `a walker without a goal fails with a message that says so`() =
        assertContains(assertFailsWith<IllegalStateException> { alone(null) }.message.orEmpty(), "the sensor data has no goal")

    @Test
    fun `two walkers who meet pass each other on the right`() {
        val walkers =
            mapOf(0 to Walker(Point2D(-0.6 to 0.0), Point2D(10.0 to 0.0)), 1 to Walker(Point2D(0.6 to 0.0), Point2D(-10.0 to 0.0)))
        val (left, right) = walk(walkers) { it.ticks(2) }.values.map { it.velocity.onGround() }
        assertTrue(left.first in 0f..1.3f && left.second < -0.1f, "the walker must slow down and move to its right (-z): $left")
        assertEquals(-left.first to -left.second, right, "the other walker must do the same in the opposite direction")
    }

    @Test
    fun `a near wall repels a walker`() {
        val (x, _) = alone(Point2D(10.0 to 0.0), Point2D(0.3 to 0.0)).onGround()
        assertTrue(x < 0, "$x")
        assertEquals(1.4f to 0f, alone(Point2D(10.0 to 0.0), Point2D(1.5 to 0.0)).onGround(), "1.25 m from the wall's surface")
        assertEquals(
            1.4f to 0f,
            alone(Point2D(10.0 to 0.0), Point2D(0.0 to 0.0)).onGround(),
            "an obstacle at the walker's centre has no direction",
        )
    }

    @Test
    fun `a warning about density spreads two hops, and warned walkers go at half speed`() {
        // Twelve walkers are within 2 m of each other, and three more are in a chain, 5 m apart.
        val dense = (0 until 12).associateWith { Point2D(0.3 * (it % 4) to 0.3 * (it / 4)) }
        val chain = mapOf(12 to Point2D(5.0 to 0.0), 13 to Point2D(10.0 to 0.0), 14 to Point2D(15.0 to 0.0))
        val answers = walk((dense + chain).mapValues { (_, place) -> Walker(place, Point2D(100.0 to 0.0)) }) { it.ticks(5) }
        assertEquals((12 / (4 * PI)).toFloat(), answers.getValue(0).density)
        assertEquals((1 / (4 * PI)).toFloat(), answers.getValue(12).density)
        for (id in 0..13) assertTrue(answers.getValue(id).warned, "node $id")
        assertFalse(answers.getValue(14).warned)
        for (id in 0..13) assertTrue(answers.getValue(id).velocity.onGround().let { (x, z) -> hypot(x, z) } <= 0.7001f, "node $id")
        assertEquals(0.7f to 0f, answers.getValue(13).velocity.onGround())
        assertEquals(1.4f to 0f, answers.getValue(14).velocity.onGround())
    }

    private class Walker(val place: Point2D, val goal: Point2D?, val obstacles: List<Point2D> = emptyList())

    private fun Vector3Value.onGround() = x to z

    private fun FlatBufferBuilder.vector(point: Point2D) = Vector3.createVector3(this, point.x.toFloat(), 0f, point.y.toFloat())

    private fun sensors(place: Point2D, walker: Walker): SensorData {
        val builder = FlatBufferBuilder()
        SensorData.startObstaclesVector(builder, walker.obstacles.size)
        walker.obstacles.asReversed().forEach { builder.vector(it) }
        val obstacles = builder.endVector()
        SensorData.startSensorData(builder)
        SensorData.addPosition(builder, builder.vector(place))
        walker.goal?.let { SensorData.addGoal(builder, builder.vector(it)) }
        SensorData.addObstacles(builder, obstacles)
        builder.finish(SensorData.endSensorData(builder))
        return SensorData.getRootAsSensorData(builder.dataBuffer())
    }
}
