package org.collektive.frames.data

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.frames.MalformedFrameException
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.util.Random
import kotlin.test.Test
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertSame

internal class GeneratedJavaTest {
    private val random = Random(7)

    @Test
    fun `readers return what was written, for structs and for tables`() {
        repeat(200) {
            read(GeneratedSchemas.features, SensorFrames.sensors(GeneratedSchemas.features, random.nextInt(5), random))
            read(GeneratedSchemas.blocks, SensorFrames.sensors(GeneratedSchemas.blocks, random.nextInt(5), random, BLOCK_BYTES))
        }
    }

    private fun read(schema: DataSchema, frame: Frame) {
        val reader = schema.sensorReader()
        reader.attach(frame.buffer(), frame.position)
        reader.check()
        assertEquals(frame.objects.map(Objects::dump), List(reader.size) { Objects.dump(unpacked(reader[it])) })
    }

    @Test
    fun `a reader returns one view for all elements and rejects other indices`() {
        val frame = SensorFrames.sensors(GeneratedSchemas.features, 2, random)
        val reader = GeneratedSchemas.features.sensorReader()
        reader.attach(frame.buffer(), frame.position)
        assertSame(reader[0], reader[1])
        assertEquals("element 2 of 2", assertFailsWith<IndexOutOfBoundsException> { reader[2] }.message)
    }

    @Test
    fun `global data reads back, and a schema without has none`() {
        val schema = GeneratedSchemas.globals
        val type = schema.sensorType.classLoader.loadClass("test.globals.GlobalData")
        val frame = SensorFrames.table(type, random)
        val reader = assertNotNull(schema.globalReader())
        reader.attach(frame.buffer(), frame.position)
        reader.check()
        assertEquals(Objects.dump(frame.objects.single()), Objects.dump(unpacked(reader.data)))
        assertNull(GeneratedSchemas.blocks.globalReader())
    }

    @Test
    fun `a table without fields is read beside tables with fields`() {
        val schema = GeneratedSchemas.of(
            "namespace test.bare; table Nothing {} table SensorData { x: int; nothing: Nothing; } table ActuatorData { x: float; }",
            "test.bare.UserSchema",
        )
        read(schema, SensorFrames.sensors(schema, 3, random))
    }

    @Test
    fun `the ranges of struct results hold exactly their bytes`() {
        val results = Array<Any?>(3) { Objects.random(GeneratedSchemas.blocks.actuatorType, random) }
        val (bytes, ranges) = write(GeneratedSchemas.blocks, results)
        for (i in results.indices) {
            val alone = write(GeneratedSchemas.blocks, arrayOf(results[i]))
            assertContentEquals(alone.first.range(alone.second, 0), bytes.range(ranges, i))
        }
    }

    @Test
    fun `packed structs are written like structs from objects`() {
        val results = Array<Any?>(5) { Objects.random(GeneratedSchemas.blocks.actuatorType, random) }
        val writer = GeneratedSchemas.blocks.actuatorWriter()
        val packed = ByteBuffer.allocate(results.size * writer.structBytes).order(ByteOrder.LITTLE_ENDIAN)
        results.forEachIndexed { i, result -> writer.pack(checkNotNull(result), packed.array(), i * writer.structBytes) }
        val builder = FlatBufferBuilder(64)
        builder.finish(writer.writePacked(builder, packed, results.size))
        assertContentEquals(write(GeneratedSchemas.blocks, results).first, builder.sizedByteArray())
        assertEquals(0, GeneratedSchemas.features.actuatorWriter().structBytes)
    }

    @Test
    fun `the ranges of table results follow each other without gap`() {
        val results = Array<Any?>(5) { Objects.random(GeneratedSchemas.features.actuatorType, random) }
        val (_, ranges) = write(GeneratedSchemas.features, results)
        var end = 0
        for (i in results.indices) {
            assertEquals(ranges[2 * i] - ranges[2 * i + 1], end)
            end = ranges[2 * i]
        }
    }

    @Test
    fun `equal results have equal bytes`() {
        fun once() = write(
            GeneratedSchemas.features,
            Array(4) {
                Objects.random(GeneratedSchemas.features.actuatorType, Random(it.toLong()))
            },
        )
        assertContentEquals(once().first, once().first)
        assertContentEquals(once().second, once().second)
    }

    private fun write(schema: DataSchema, results: Array<Any?>): Pair<ByteArray, IntArray> {
        val builder = FlatBufferBuilder(64)
        val ranges = IntArray(2 * results.size)
        builder.finish(schema.actuatorWriter().write(builder, results, results.size, ranges))
        return builder.sizedByteArray() to ranges
    }

    private fun ByteArray.range(ranges: IntArray, i: Int) = copyOfRange(size - ranges[2 * i], size - ranges[2 * i] + ranges[2 * i + 1])

    @Test
    fun `a result that cannot be written has a fault that names the reason`() {
        val blocks = GeneratedSchemas.blocks.actuatorWriter()
        assertEquals("the result is null", blocks.findFault(null))
        assertEquals("the result is a java.lang.String, not a test.blocks.ActuatorDataT", blocks.findFault("x"))
        assertEquals("target is null", blocks.findFault(made(GeneratedSchemas.blocks).set("Target", null)))

        val features = GeneratedSchemas.features.actuatorWriter()
        fun fault(change: Any.() -> Any) = features.findFault(made(GeneratedSchemas.features).change())
        val loader = GeneratedSchemas.features.actuatorType.classLoader
        val leaf = loader.loadClass("test.features.LeafT")
        assertNull(fault { this })
        assertEquals("label is null", fault { set("Label", null) })
        assertEquals("label holds half a surrogate pair", fault { set("Label", "x\ud83d") })
        assertEquals("words[1] is null", fault { set("Words", arrayOf("a", null)) })
        assertEquals("words[0] holds half a surrogate pair", fault { set("Words", arrayOf("\ude80")) })
        assertEquals("leaves[0].name is null", fault { set("Leaves", array(leaf, leaf.getConstructor().newInstance())) })
        assertEquals("leaves[0] is null", fault { set("Leaves", array(leaf, null)) })
        val path = loader.loadClass("org.collektive.schema.Vector3T")
        assertEquals("path[0] is null", fault { set("Path", array(path, null)) })
    }

    @Test
    fun `a result that contains itself is refused, and the deepest allowed one is written`() {
        val type = GeneratedSchemas.features.actuatorType.classLoader.loadClass("test.features.TreeT")
        val round = type.getConstructor().newInstance()
        round.set("Left", round)
        val writer = GeneratedSchemas.features.actuatorWriter()
        val fault = assertNotNull(writer.findFault(made(GeneratedSchemas.features).set("Tree", round)))
        assertEquals("tree" + ".left".repeat(63) + " is nested deeper than 64 tables", fault)
        var deep = type.getConstructor().newInstance()
        repeat(62) { deep = type.getConstructor().newInstance().set("Left", deep) }
        val result = made(GeneratedSchemas.features).set("Tree", deep)
        assertNull(writer.findFault(result))
        write(GeneratedSchemas.features, arrayOf(result))
    }

    private fun made(schema: DataSchema) = Objects.random(schema.actuatorType, random)

    private fun Any.set(field: String, value: Any?): Any = apply { javaClass.methods.single { it.name == "set$field" }.invoke(this, value) }

    private fun array(type: Class<*>, item: Any?): Any =
        java.lang.reflect.Array.newInstance(type, 1).also { java.lang.reflect.Array.set(it, 0, item) }

    @Test
    fun `a frame outside the buffer's position and limit is malformed`() {
        val frame = SensorFrames.sensors(GeneratedSchemas.blocks, 3, random, BLOCK_BYTES)
        val reader = GeneratedSchemas.blocks.sensorReader()
        assertFailsWith<MalformedFrameException> { reader.attach(frame.buffer().limit(frame.bytes.size - 1), frame.position) }
        assertFailsWith<MalformedFrameException> { reader.attach(frame.buffer().position(frame.position + 1), frame.position) }
        assertFailsWith<MalformedFrameException> { reader.attach(frame.buffer(), -1) }
        assertFailsWith<MalformedFrameException> { reader.attach(frame.buffer(), Int.MAX_VALUE) }
    }

    @Test
    fun `the message names the element and the field`() {
        val frame = SensorFrames.sensors(GeneratedSchemas.features, 3, Random(11))
        val messages = HashSet<String>()
        val mutator = Random(3)
        repeat(3000) {
            val bytes = frame.bytes.clone()
            bytes[mutator.nextInt(bytes.size)] = mutator.nextInt().toByte()
            val reader = GeneratedSchemas.features.sensorReader()
            try {
                reader.attach(Frame(bytes, frame.position, emptyList()).buffer(), frame.position)
                reader.check()
            } catch (e: MalformedFrameException) {
                messages += e.message.orEmpty()
            }
        }
        assertContainsMatching(messages, Regex("""data\[\d]\.main\.name .*"""))
        assertContainsMatching(messages, Regex("""data\[\d]\.label .*"""))
    }

    private fun assertContainsMatching(texts: Set<String>, pattern: Regex) =
        assertNotNull(texts.find(pattern::matches), "none of $texts is like $pattern")

    private companion object {
        const val BLOCK_BYTES = 104
    }
}
