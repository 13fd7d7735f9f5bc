package org.collektive.bench.rounds

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.api.Parameters
import org.collektive.engine.Engine
import org.collektive.engine.EngineSettings
import org.collektive.engine.LinkList
import org.collektive.engine.NewNode
import org.collektive.engine.NodeProgram
import org.collektive.engine.RoundData
import org.collektive.engine.RoundDevice
import org.collektive.engine.Tick
import org.collektive.engine.TickResult
import org.collektive.runtime.AggregateRuntimes

/** The engine, with one thread and the same program on every device of [topology]. */
public class EngineRounds(program: String, private val topology: Topology) : AutoCloseable {
    private val engine = Engine(EngineSettings(seed = 0), AggregateRuntimes())
    private val tick = Tick()
    private val program = Program(program)
    private val data = Data(sensorData(topology))

    init {
        val links = LinkList()
        for (id in 0 until topology.size) {
            tick.nodesAdded += NewNode(id, this.program, Parameters(emptyMap()))
            for (neighbor in topology.neighbors[id]) links.add(neighbor, id, topology.distance(id, neighbor).toFloat(), 0f)
            tick.due.add(id)
        }
        tick.links = links
        tick()
        tick.nodesAdded.clear()
        links.clear()
    }

    /** Runs one round of every device. */
    public fun tick(): TickResult {
        tick.number++
        tick.time += 1.0
        tick.deltaTime = 1.0
        val result = engine.step(tick, data, System.nanoTime() + LIMIT)
        check(result.failureCount == 0) { "a round failed: ${(0 until result.size).firstNotNullOf(result::failure)}" }
        return result
    }

    override fun close() {
        engine.close()
    }

    private class Data(private val sensorData: List<SensorData>) : RoundData {
        override fun sensors(worker: Int, index: Int): Any = sensorData[index]

        override fun pack(worker: Int, index: Int, answer: Any): String? = null
    }

    private class Program(override val name: String) : NodeProgram {
        private val code: Aggregate<Int>.(SensorData) -> Any = when (name) {
            "a" -> { sensorData -> gradientAscent(sensorData) }
            "b" -> { sensorData -> distanceFromSource(sensorData) }
            "b2" -> { sensorData -> bellmanFordFromSource(sensorData) }
            "c" -> { sensorData -> followers(sensorData) }
            else -> throw IllegalArgumentException("unknown program '$name'; use a, b, b2 or c")
        }

        @Suppress("UNCHECKED_CAST")
        override fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any =
            (aggregate as Aggregate<Int>).code(sensors as SensorData)

        override fun describe(failure: Throwable, place: String?): String = failure.stackTraceToString()
    }

    private companion object {
        const val LIMIT = 60_000_000_000
    }
}
