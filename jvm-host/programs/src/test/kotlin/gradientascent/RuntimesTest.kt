package gradientascent

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.util.Point2D
import org.collektive.schema.Vector3Value
import samples.Swarm
import kotlin.math.hypot
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals

/** Tests that the case study moves a swarm in the same way on the project's own runtime and on Collektive's public API. */
class RuntimesTest {
    @Test
    fun `both runtimes compute the same positions for hundreds of ticks`() {
        val own = run("builtIn")
        assertEquals(own, run("collektive"))
        assertEquals(TICKS, own.distinct().size, "the swarm must move in every tick")
    }

    /** Returns the targets of each tick while nodes move, and while nodes are added and removed. */
    private fun run(runtime: String): List<Map<Int, List<Float>>> =
        Swarm(RANGE, mapOf("step" to "1.0"), { _, place -> sense(place) }, Aggregate<Int>::gradientAscent, runtime).use { swarm ->
            val random = Random(7)
            var nextId = 0
            (1..TICKS).map { number ->
                if (swarm.places.size == NODES) swarm.places.remove(swarm.places.keys.random(random))
                while (swarm.places.size <
                    NODES - number % 2
                ) {
                    swarm.places[nextId++] = Point2D(random.nextDouble() * SIZE to random.nextDouble() * SIZE)
                }
                swarm.tick().mapValues { (id, answer) ->
                    val target = answer.target
                    swarm.places[id] = Point2D(target.x.toDouble() to target.z.toDouble())
                    listOf(target.x, target.y, target.z)
                }
            }
        }

    private fun sense(place: Point2D): SensorData {
        val x = place.x.toFloat()
        val z = place.y.toFloat()
        return sensors(100f - hypot(x, z), Vector3Value(x, 1f, z), Vector3Value(SIZE / 2 - x, 0f, SIZE / 2 - z))
    }

    private companion object {
        const val TICKS = 300
        const val NODES = 30
        const val SIZE = 15f
        const val RANGE = 5.0
    }
}
