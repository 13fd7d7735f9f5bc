package org.collektive.frames.data

import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import org.collektive.frames.MalformedFrameException
import org.junit.jupiter.api.Tag
import java.util.Random
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** Tests reading data with the binary schema alone. Untrusted records are read in this way, because it runs no generated code. */
internal class ReflectionReaderTest {
    private val random = Random(3)

    @Test
    fun `elements are read as generated code reads them`() {
        for (schema in listOf(GeneratedSchemas.features, GeneratedSchemas.blocks)) {
            val reflection = reflectionReader(schema)
            val elements = reflection.elements(schema.sensorType.name)
            repeat(100) {
                val frame = sensors(schema)
                elements.attach(frame.buffer(), frame.position)
                elements.check()
                val read = List(elements.size) { Objects.dump(reflection.read(schema.sensorType.name, elements.frame, elements.place(it))) }
                assertEquals(frame.objects.map(Objects::dump), read)
            }
        }
    }

    @Test
    fun `tables are verified with their layout, and unknown types are rejected`() {
        val schema = GeneratedSchemas.globals
        val reflection = reflectionReader(schema)
        assertEquals("test.globals.GlobalData", reflection.find("GlobalData"))
        assertNull(reflection.find("Other"))
        val checker = FrameChecker(FramePolicy.USER_DATA)
        val frame = SensorFrames.table(schema, "test.globals.GlobalData", random)
        checker.check(frame.buffer(), frame.position, reflection.table("test.globals.GlobalData"))
        assertFailsWith<MalformedFrameException> {
            checker.check(frame.buffer().limit(frame.bytes.size - 1), frame.position, reflection.table("test.globals.GlobalData"))
        }
        assertContains(
            assertFailsWith<MalformedFrameException> {
                reflection.elements("test.Other")
            }.message.orEmpty(),
            "does not define test.Other",
        )
    }

    @Tag("slow")
    @Test
    fun `a damaged schema is rejected, or reads only verified data`() {
        var refused = 0
        repeat(5_000) { number ->
            val schema = if (number % 2 == 0) GeneratedSchemas.features else GeneratedSchemas.blocks
            val bytes = binarySchema(schema)
            repeat(1 + random.nextInt(3)) { damage(bytes) }
            val frame = sensors(schema)
            try {
                val reflection = ReflectionReader(bytes)
                val elements = reflection.elements(schema.sensorType.name)
                elements.attach(frame.buffer(), frame.position)
                elements.check()
                for (i in 0 until elements.size) reflection.read(schema.sensorType.name, elements.frame, elements.place(i))
            } catch (_: MalformedFrameException) {
                refused++
            }
        }
        assertTrue(refused in 1_250 until 5_000, "$refused schemas were rejected")
    }

    private fun damage(bytes: ByteArray) {
        val at = random.nextInt(bytes.size - 3)
        if (random.nextBoolean()) {
            bytes[at] = (bytes[at].toInt() xor (1 shl random.nextInt(8))).toByte()
        } else {
            val number = listOf(0, 1, -1, 0x7FFF, 0xFFFF, Int.MAX_VALUE, random.nextInt(64))[random.nextInt(7)]
            for (k in 0..3) bytes[at + k] = (number ushr 8 * k).toByte()
        }
    }

    private fun sensors(schema: DataSchema) =
        SensorFrames.sensors(schema, 1 + random.nextInt(3), random, if (schema === GeneratedSchemas.blocks) BLOCK_BYTES else null)

    private companion object {
        const val BLOCK_BYTES = 104
    }
}
