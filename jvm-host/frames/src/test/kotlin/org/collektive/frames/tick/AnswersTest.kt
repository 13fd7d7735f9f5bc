package org.collektive.frames.tick

import org.collektive.api.Parameters
import org.collektive.engine.Engine
import org.collektive.engine.EngineSettings
import org.collektive.engine.NewNode
import org.collektive.engine.NodeProgram
import org.collektive.engine.RoundData
import org.collektive.engine.RoundDevice
import org.collektive.engine.RoundDigest
import org.collektive.engine.Tick
import org.collektive.engine.TickResult
import org.collektive.frames.AnswerBuffer
import org.collektive.frames.data.DataSchema
import org.collektive.frames.data.ElementReader
import org.collektive.frames.data.GlobalReader
import org.collektive.frames.data.StructWriter
import org.collektive.frames.data.View
import org.collektive.runtime.AggregateRuntimes
import org.junit.jupiter.api.Test
import java.nio.ByteBuffer
import java.nio.ByteOrder
import kotlin.random.Random
import kotlin.test.assertEquals

/** Tests answers that are structs of 12 bytes: 4 for the node's id and 8 for the tick. */
class AnswersTest {
    private val failing = HashSet<Int>()
    private var now = 0L
    private val answers = Answers.of(Schema)
    private val data = object : RoundData {
        override fun sensors(worker: Int, index: Int): Any? = null

        override fun pack(worker: Int, index: Int, answer: Any): String? = answers.pack(worker, index, answer)
    }
    private val program = object : NodeProgram {
        override val name get() = "test"

        override fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any {
            check(device.id !in failing || device.id % 2 == 0)
            return if (device.id in failing) "no answer" else Answer(device.id, now)
        }

        override fun describe(failure: Throwable, place: String?): String = failure.toString()
    }

    @Test
    fun `the answers of successful rounds are contiguous and in the digest, whichever rounds fail`() {
        val random = Random(7)
        val digest = RoundDigest()
        val expected = RoundDigest()
        Engine(EngineSettings(1, THREADS), AggregateRuntimes()).use { engine ->
            for (number in 1L..60L) {
                now = number
                val tick = Tick()
                tick.number = number
                if (number == 1L) for (id in 0 until NODES) tick.nodesAdded.add(NewNode(id, program, Parameters(emptyMap())))
                val due = (0 until NODES).filter { random.nextInt(4) > 0 }
                due.forEach(tick.due::add)
                failing.clear()
                // The percentage of failed rounds, from none to all.
                val percent = number.toInt() % 5 * 25
                due.filterTo(failing) { random.nextInt(100) < percent }
                answers.begin(tick.due)
                val result = engine.step(tick, data, System.nanoTime() + 10_000_000_000)
                assertEquals(due.filter { it !in failing }.map { it to number }, written(result, digest), "tick $number")
                digestOf(number, due, expected)
                assertEquals(expected.value, digest.value, "tick $number")
            }
        }
    }

    private fun written(result: TickResult, digest: RoundDigest): List<Pair<Int, Long>> {
        val memory = ByteBuffer.allocateDirect(64 * NODES).order(ByteOrder.LITTLE_ENDIAN)
        val buffer = AnswerBuffer { _, _, capacity -> ByteBuffer.allocateDirect(capacity) }
        buffer.begin(1, memory)
        digest.begin(now)
        val table = answers.write(result, buffer, digest)
        digest.end()
        val place = memory.capacity() - table
        val field = memory.getShort(place - memory.getInt(place) + 4)
        val vector = place + field + memory.getInt(place + field)
        return List(memory.getInt(vector)) {
            val at = vector + 4 + it * Schema.BYTES
            memory.getInt(at) to memory.getLong(at + 4)
        }
    }

    private fun digestOf(tick: Long, due: List<Int>, digest: RoundDigest) {
        val bytes = ByteBuffer.allocate(Schema.BYTES).order(ByteOrder.LITTLE_ENDIAN)
        digest.begin(tick)
        for (id in due) {
            if (id in failing) digest.failure(id) else digest.answer(id, bytes.putInt(0, id).putLong(4, tick), 0, Schema.BYTES)
        }
        digest.end()
    }

    private class Answer(val id: Int, val tick: Long)

    private object Schema : DataSchema {
        const val BYTES = 12
        override val name get() = "test"
        override val types get() = emptyMap<String, Long>()
        override val sensorType get() = Any::class.java
        override val actuatorType get() = Answer::class.java

        override fun sensorReader(): ElementReader = throw UnsupportedOperationException()

        override fun sensorView(): View = throw UnsupportedOperationException()

        override fun actuatorReader(): ElementReader = throw UnsupportedOperationException()

        override fun globalReader(): GlobalReader? = null

        override fun actuatorWriter() = StructWriter(Answer::class.java, BYTES, 4) { target, place, answer ->
            answer as Answer
            target.putInt(place, answer.id)
            target.putLong(place + 4, answer.tick)
        }
    }

    private companion object {
        const val THREADS = 2
        const val NODES = 300
    }
}
