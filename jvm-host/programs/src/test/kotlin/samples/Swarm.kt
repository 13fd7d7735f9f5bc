package samples

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.util.Point2D
import org.collektive.api.Device
import org.collektive.api.Parameters
import org.collektive.engine.Engine
import org.collektive.engine.EngineSettings
import org.collektive.engine.LinkList
import org.collektive.engine.NewNode
import org.collektive.engine.NodeProgram
import org.collektive.engine.RoundData
import org.collektive.engine.RoundDevice
import org.collektive.engine.Schedule
import org.collektive.engine.Tick
import org.collektive.runtime.AggregateRuntimes
import org.collektive.spi.DeviceRuntimes

/**
 * Devices on the ground. All run [round] in each tick, on the data that [sense] returns for id and position. Two are linked while they are
 * less than [range] metres apart.
 */
internal class Swarm<S : Any, A : Any>(
    private val range: Double,
    parameters: Map<String, String>,
    private val sense: (id: Int, at: Point2D) -> S,
    private val round: Aggregate<Int>.(S, Device) -> A,
    runtimes: DeviceRuntimes = AggregateRuntimes(),
) : AutoCloseable {
    /** The position of each device by id. Change it between ticks to add, move and remove devices. */
    val places = sortedMapOf<Int, Point2D>()

    private val engine = Engine(EngineSettings(1, 2, Schedule.LOCKSTEP), runtimes)
    private val parameters = Parameters(parameters)
    private val known = HashSet<Int>()
    private val links = HashSet<Pair<Int, Int>>()
    private var ticks = 0L

    private val program = object : NodeProgram {
        override val name = "sample"

        @Suppress("UNCHECKED_CAST")
        override fun round(aggregate: Any, sensors: Any?, device: RoundDevice) = (aggregate as Aggregate<Int>).round(sensors as S, device)

        override fun describe(failure: Throwable, place: String?) = failure.toString()
    }

    /** Runs one tick and returns the answers by id. @throws IllegalStateException when a round failed. */
    fun tick(): Map<Int, A> {
        val tick = Tick()
        tick.number = ++ticks
        tick.time = ticks * DELTA
        tick.deltaTime = DELTA
        writeChanges(tick)
        places.keys.forEach(tick.due::add)
        val seen = places.map { (id, place) -> sense(id, place) }
        val data = object : RoundData {
            override fun sensors(worker: Int, index: Int) = seen[index]

            override fun pack(worker: Int, index: Int, answer: Any): String? = null
        }
        val result = engine.step(tick, data, System.nanoTime() + LIMIT)
        return (0 until result.size).associate { index ->
            result.failure(index)?.let(::error)
            @Suppress("UNCHECKED_CAST")
            result.id(index) to result.answer(index) as A
        }
    }

    /** Runs [count] ticks and returns the answers of the last. */
    fun ticks(count: Int): Map<Int, A> {
        repeat(count - 1) { tick() }
        return tick()
    }

    override fun close() = engine.close()

    private fun writeChanges(tick: Tick) {
        for (gone in known - places.keys) {
            known -= gone
            links.removeIf { it.first == gone || it.second == gone }
            tick.nodesRemoved.add(gone)
        }
        for (new in places.keys - known) {
            known += new
            tick.nodesAdded += NewNode(new, program, parameters)
        }
        val near = places.keys.flatMap { a ->
            places.keys.filter { b -> a != b && places.getValue(a).distanceTo(places.getValue(b)) < range }.map { b -> a to b }
        }
        for ((from, to) in links - near.toSet()) {
            tick.linksRemoved.add(from)
            tick.linksRemoved.add(to)
        }
        tick.links = LinkList().also { made -> for ((from, to) in near - links) made.add(from, to, 1f, 0f) }
        links.clear()
        links += near
    }

    private companion object {
        const val DELTA = 0.05
        const val LIMIT = 60_000_000_000
    }
}
