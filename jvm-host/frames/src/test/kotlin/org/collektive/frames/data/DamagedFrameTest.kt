package org.collektive.frames.data

import org.collektive.frames.MalformedFrameException
import org.junit.jupiter.api.Tag
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.util.Random
import kotlin.test.Test
import kotlin.test.assertTrue

/** Tests that any frame is either readable to its end or rejected with a [MalformedFrameException]. */
@Tag("slow")
internal class DamagedFrameTest {
    private val random = Random(42)

    @Test
    fun `frames with flipped bits are rejected or readable`() = attack { bytes ->
        repeat(1 + random.nextInt(4)) {
            val at = random.nextInt(bytes.size)
            bytes[at] = (bytes[at].toInt() xor (1 shl random.nextInt(8))).toByte()
        }
        bytes
    }

    @Test
    fun `frames with extreme numbers are rejected or readable`() = attack { bytes ->
        repeat(1 + random.nextInt(3)) {
            val number = listOf(0, 1, -1, 4, 5, 0x7F, 0x7FFF, 0x8000, 0xFFFF, Int.MAX_VALUE, Int.MIN_VALUE, bytes.size)[random.nextInt(12)]
            val at = random.nextInt(bytes.size - 3)
            for (k in 0..3) bytes[at + k] = (number ushr 8 * k).toByte()
        }
        bytes
    }

    @Test
    fun `truncated frames are rejected or readable`() = attack { bytes -> bytes.copyOf(random.nextInt(bytes.size)) }

    @Test
    fun `frames of random bytes are rejected or readable`() = attack(count = 100) { bytes -> bytes.also(random::nextBytes) }

    private fun attack(count: Int = 1500, damage: (ByteArray) -> ByteArray) {
        var passed = 0
        var refused = 0
        repeat(count) {
            val (schema, frame) = when (it % 2) {
                0 -> GeneratedSchemas.features to SensorFrames.sensors(GeneratedSchemas.features, 1 + random.nextInt(3), random)
                else -> GeneratedSchemas.blocks to SensorFrames.sensors(GeneratedSchemas.blocks, 1 + random.nextInt(3), random, 104)
            }
            if (survives(schema, Frame(damage(frame.bytes), frame.position, emptyList()))) passed++ else refused++
        }
        repeat(count / 5) {
            val schema = GeneratedSchemas.globals
            val frame = SensorFrames.table(schema, "test.globals.GlobalData", random)
            val reader = checkNotNull(schema.globalReader())
            val damaged = ByteBuffer.wrap(damage(frame.bytes)).order(ByteOrder.LITTLE_ENDIAN)
            try {
                reader.attach(damaged, frame.position)
                reader.check()
                GeneratedSchemas.unpacked(schema, "test.globals.GlobalData", damaged, frame.position)
            } catch (e: MalformedFrameException) {
                refused++
            }
        }
        assertTrue(refused > 0, "at least one frame must be rejected, but all $passed were readable")
    }

    private fun survives(schema: DataSchema, frame: Frame): Boolean {
        val reader = schema.sensorReader()
        try {
            reader.attach(frame.buffer(), frame.position)
            reader.check()
        } catch (e: MalformedFrameException) {
            return false
        }
        val reflection = reflectionReader(schema)
        for (i in 0 until reader.size) {
            GeneratedSchemas.unpacked(schema, schema.sensorType.name, reader.frame, reader.place(i))
            reflection.read(schema.sensorType.name, reader.frame, reader.place(i))
        }
        return true
    }
}
