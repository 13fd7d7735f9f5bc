package org.collektive.bench.tick

import com.google.flatbuffers.FlatBufferBuilder
import gradientascent.GradientAscentSchema
import gradientascent.SensorData
import gradientascent.gradientAscent
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
import org.collektive.runtime.AggregateRuntimes
import org.collektive.schema.Vector3
import java.nio.ByteBuffer

/** Only the rounds of the case study, without C#, frames and answers. The sensor data is prepared in memory. */
internal class EngineOnly(private val grid: Grid, threads: Int) :
    Workload,
    RoundData {
    private val engine = Engine(EngineSettings(SEED, threads), AggregateRuntimes())
    private val schema = GradientAscentSchema()
    private val frames = List(FRAMES) { sensors(it.toLong()) }
    private val readers = frames.map { frame -> schema.sensorReader().apply { attach(frame, frame.getInt(0)) } }
    private val views = List(threads) { schema.sensorView() }
    private val writer = schema.actuatorWriter()
    private val tick = Tick()
    private var now = readers[0]

    override fun tick() {
        val number = tick.number + 1
        if (number > 1) tick.clear()
        tick.number = number
        tick.time = number * DELTA_TIME
        tick.deltaTime = DELTA_TIME
        if (number == 1L) {
            for (node in 0 until grid.size) tick.nodesAdded.add(NewNode(node, GradientAscent, PARAMETERS))
            tick.links = LinkList().also { links -> grid.forEachLink { from, to, length -> links.add(from, to, length, 0f) } }
        }
        for (node in 0 until grid.size) tick.due.add(node)
        now = readers[(number % FRAMES).toInt()]
        engine.step(tick, this, System.nanoTime() + LIMIT_NANOS)
    }

    override fun sensors(worker: Int, index: Int): Any = views[worker].at(now.place(index), now.frame)

    override fun pack(worker: Int, index: Int, answer: Any): String? = writer.findProblem(answer)

    override fun close() = engine.close()

    /** Creates a frame whose root is the table `Sensors` of [tick]. */
    private fun sensors(tick: Long): ByteBuffer {
        val builder = FlatBufferBuilder(1 shl 16)
        val elements = IntArray(grid.size) { node ->
            val obstacles = if (node % Grid.OBSTACLE_EVERY != 0) {
                0
            } else {
                SensorData.startObstaclesVector(builder, 1)
                Vector3.createVector3(builder, Grid.OBSTACLE_X, 0f, Grid.OBSTACLE_Z)
                builder.endVector()
            }
            SensorData.startSensorData(builder)
            SensorData.addIntensity(builder, grid.intensity(node, tick))
            SensorData.addPosition(builder, Vector3.createVector3(builder, grid.x(node), 0f, grid.z(node)))
            if (obstacles != 0) SensorData.addObstacles(builder, obstacles)
            SensorData.endSensorData(builder)
        }
        val data = builder.createVectorOfTables(elements)
        builder.startTable(1)
        builder.addOffset(0, data, 0)
        builder.finish(builder.endTable())
        return ByteBuffer.allocateDirect(
            builder.sizedByteArray().size,
        ).order(java.nio.ByteOrder.LITTLE_ENDIAN).put(builder.sizedByteArray()).flip()
    }

    private object GradientAscent : NodeProgram {
        override val name get() = "gradient-ascent"

        @Suppress("UNCHECKED_CAST")
        override fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any? =
            (aggregate as Aggregate<Int>).gradientAscent(sensors as SensorData, device)

        override fun describe(failure: Throwable, place: String?): String = failure.toString()
    }

    private companion object {
        const val SEED = 1L
        const val DELTA_TIME = 0.05
        const val LIMIT_NANOS = 60_000_000_000

        /** Number of prepared inputs, used in turn. */
        const val FRAMES = 4
        val PARAMETERS = Parameters(mapOf("step" to "1.0"))
    }
}
