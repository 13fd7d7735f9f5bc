package gradientascent

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.impl.ProgramPlace
import org.collektive.api.Device
import org.collektive.api.Parameters
import org.collektive.engine.Engine
import org.collektive.engine.EngineSettings
import org.collektive.engine.MailboxRuntimes
import org.collektive.engine.NewNode
import org.collektive.engine.NodeProgram
import org.collektive.engine.RoundData
import org.collektive.engine.Schedule
import org.collektive.engine.Tick
import org.collektive.runtime.AggregateRuntimes
import org.collektive.runtime.DeviceRuntimes
import kotlin.math.hypot
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals

/** The case study moves a swarm the same way on the project's own runtime and on Collektive's public API. */
class RuntimesTest {
    private object CaseStudy : NodeProgram {
        override val name = "gradient-ascent"
        override fun round(aggregate: Aggregate<Int>, sensors: Any?, device: Device) = aggregate.gradientAscent(sensors as SensorData, device)
        override fun describe(failure: Throwable, place: ProgramPlace?) = failure.toString()
    }

    @Test
    fun `both runtimes give the same positions for hundreds of ticks`() {
        val own = run(AggregateRuntimes())
        assertEquals(own, run(MailboxRuntimes()))
        assertEquals(TICKS, own.distinct().size, "the swarm moves")
    }

    /** All targets of each tick, while nodes move, come and go. */
    private fun run(runtimes: DeviceRuntimes): List<Map<Int, List<Float>>> = Engine(EngineSettings(1, 2, Schedule.LOCKSTEP), runtimes).use { engine ->
        val random = Random(7)
        val places = sortedMapOf<Int, Pair<Float, Float>>()
        val links = HashSet<Pair<Int, Int>>()
        var nextId = 0
        (1..TICKS).map { number ->
            val tick = Tick()
            tick.number = number.toLong()
            tick.time = number * DELTA
            tick.deltaTime = DELTA
            if (places.size == NODES) {
                val gone = places.keys.random(random)
                places.remove(gone)
                links.removeIf { it.first == gone || it.second == gone }
                tick.nodesRemoved.add(gone)
            }
            while (places.size < NODES - number % 2) {
                places[nextId] = random.nextFloat() * SIZE to random.nextFloat() * SIZE
                tick.nodesAdded += NewNode(nextId++, CaseStudy, Parameters(mapOf("step" to "1.0")))
            }
            val near = places.keys.flatMap { a -> places.keys.filter { b -> a != b && distance(places.getValue(a), places.getValue(b)) < RANGE }.map { a to it } }
            for ((from, to) in links - near.toSet()) {
                tick.linksRemoved.add(from)
                tick.linksRemoved.add(to)
            }
            for ((from, to) in near - links) tick.links.add(from, to, 1f, 0f)
            links.clear()
            links += near
            places.keys.forEach(tick.due::add)
            val seen = places.values.map { (x, z) -> sensors(100f - hypot(x, z), vector(x, 1f, z), vector(SIZE / 2 - x, 0f, SIZE / 2 - z)) }
            val data = object : RoundData {
                override fun sensors(worker: Int, index: Int) = seen[index]
                override fun fault(worker: Int, answer: Any): String? = null
            }
            val result = engine.step(tick, data, System.nanoTime() + LIMIT)
            (0 until result.size).associate { index ->
                val target = (result.answer(index) as ActuatorDataT).target
                places[result.id(index)] = target.x to target.z
                result.id(index) to listOf(target.x, target.y, target.z)
            }
        }
    }

    private fun distance(a: Pair<Float, Float>, b: Pair<Float, Float>) = hypot(a.first - b.first, a.second - b.second)

    private companion object {
        const val TICKS = 300
        const val NODES = 30
        const val SIZE = 15f
        const val RANGE = 5f
        const val DELTA = 0.05
        const val LIMIT = 60_000_000_000
    }
}
