package org.collektive.frames.data

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.frames.MalformedFrameException
import java.lang.reflect.InvocationTargetException
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.util.Random
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertSame

internal class GeneratedCodeTest {
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
        val reflection = reflectionReader(schema)
        val read = List(reader.size) { Objects.dump(reflection.read(schema.sensorType.name, reader.frame, reader.place(it))) }
        assertEquals(frame.objects.map(Objects::dump), read)
    }

    @Test
    fun `one view serves all elements, and other indices are rejected`() {
        val schema = GeneratedSchemas.features
        val frame = SensorFrames.sensors(schema, 2, random)
        val reader = schema.sensorReader()
        reader.attach(frame.buffer(), frame.position)
        val view = schema.sensorView()
        val label = schema.sensorType.getMethod("label")
        val labels = frame.objects.map { it.javaClass.getMethod("getLabel").invoke(it) }
        assertEquals(labels, List(2) { label.invoke(view.at(reader.place(it), reader.frame)) })
        assertSame(view.at(reader.place(0), reader.frame), view.at(reader.place(1), reader.frame))
        assertEquals("element 2 of 2", assertFailsWith<IndexOutOfBoundsException> { reader.place(2) }.message)
    }

    @Test
    fun `global data is read back, and a schema without it has no reader`() {
        val schema = GeneratedSchemas.globals
        val frame = SensorFrames.table(schema, "test.globals.GlobalData", random)
        val reader = assertNotNull(schema.globalReader())
        reader.attach(frame.buffer(), frame.position)
        reader.check()
        assertEquals(frame.objects.single().let { it.javaClass.getMethod("getGain").invoke(it) }, gain(reader.data))
        val tree = reflectionReader(schema).read(reader.data.javaClass.name, frame.buffer(), frame.position)
        assertEquals(Objects.dump(frame.objects.single()), Objects.dump(tree))
        assertNull(GeneratedSchemas.blocks.globalReader())
    }

    private fun gain(data: Any) = data.javaClass.getMethod("gain").invoke(data)

    @Test
    fun `a table without fields is read beside tables with fields`() {
        val schema = GeneratedSchemas.of(
            "namespace test.bare; table Nothing {} table SensorData { x: int; nothing: Nothing; } table ActuatorData { x: float; }",
            "test.bare.UserSchema",
        )
        read(schema, SensorFrames.sensors(schema, 3, random))
    }

    @Test
    fun `flatc reads the written results, for structs and for tables`() {
        for (schema in listOf(GeneratedSchemas.features, GeneratedSchemas.blocks)) {
            repeat(200) { assertWritten(schema, Array(random.nextInt(5)) { Objects.randomResult(schema, random) }) }
        }
    }

    @Test
    fun `negative zero is written although it is equal to the default`() {
        val schema = GeneratedSchemas.of(
            "namespace test.zero; table SensorData { x: int; } table ActuatorData { x: double; y: float; z: float = 1; }",
            "test.zero.UserSchema",
        )
        val real = Float::class.java
        assertWritten(schema, arrayOf(schema.actuatorType.getConstructor(Double::class.java, real, real).newInstance(-0.0, -0f, -0f)))
    }

    private fun assertWritten(schema: DataSchema, results: Array<Any?>) {
        val builder = FlatBufferBuilder(64)
        val table = schema.actuatorWriter().writeAll(builder, results)
        builder.finish(table)
        val bytes = builder.sizedByteArray()
        val reader = schema.actuatorReader()
        reader.attach(ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN), bytes.size - table)
        reader.check()
        val read = List(reader.size) { GeneratedSchemas.unpacked(schema, schema.actuatorType.name, reader.frame, reader.place(it)) }
        assertEquals(results.map(Objects::dump), read.map(Objects::dump))
    }

    @Test
    fun `results default to the values of the schema, and structs to zero`() {
        val blocks = GeneratedSchemas.blocks.actuatorType.getConstructor().newInstance()
        val inner = "InnerValue(flag=false, weight=0.0, mode=0)"
        assertContains("$blocks", "active=false, inner=$inner, target=Vector3Value(x=0.0, y=0.0, z=0.0)")
        val tree = GeneratedSchemas.features.actuatorType.classLoader.loadClass("test.features.TreeValue").getConstructor().newInstance()
        assertEquals("TreeValue(leaf=null, leaves=null, left=null, children=null)", "$tree")
    }

    @Test
    fun `the ranges of table results are contiguous`() {
        val results = Array<Any?>(5) { Objects.randomResult(GeneratedSchemas.features, random) }
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
                Objects.randomResult(GeneratedSchemas.features, Random(it.toLong()))
            },
        )
        assertContentEquals(once().first, once().first)
        assertContentEquals(once().second, once().second)
    }

    private fun write(schema: DataSchema, results: Array<Any?>): Pair<ByteArray, IntArray> {
        val builder = FlatBufferBuilder(64)
        val ranges = IntArray(2 * results.size)
        builder.finish(schema.actuatorWriter().writeAll(builder, results, ranges))
        return builder.sizedByteArray() to ranges
    }

    @Test
    fun `the error of a result that cannot be written names the reason`() {
        val blocks = GeneratedSchemas.blocks.actuatorWriter()
        assertEquals("the program returned null", blocks.findProblem(null))
        assertEquals("the program returned a java.lang.String instead of a test.blocks.ActuatorData", blocks.findProblem("x"))

        val features = GeneratedSchemas.features.actuatorWriter()
        fun problem(field: String, value: Any?) = features.findProblem(resultWith(field to value))
        assertNull(problem("text", "a \ud83d\ude80"))
        assertEquals("label contains an unpaired surrogate", problem("label", "x\ud83d"))
        assertEquals("words[1] is null", problem("words", listOf("a", null)))
        assertEquals("words[0] contains an unpaired surrogate", problem("words", listOf("\ude80")))
        val modes = intArrayOf(0, 255, 0)
        val result = resultWith("modes" to modes)
        assertNull(features.findProblem(result))
        modes[2] = 256
        assertEquals("modes[2] is 256; it must be from 0 to 255", features.findProblem(result))
        assertEquals("leaves[0] is null", problem("leaves", listOf(null)))
        assertEquals("path[0] is null", problem("path", listOf(null)))
        val tree = type("TreeValue").constructors.single { it.parameterCount == 1 }.newInstance(leaf("\ud83d"))
        assertEquals("tree.leaf.name contains an unpaired surrogate", problem("tree", tree))
    }

    @Test
    fun `a required field can be neither missing nor null, even from Java`() {
        assertEquals(emptyList(), type("LeafValue").constructors.filter { it.parameterCount == 0 })
        val refusal = assertFailsWith<InvocationTargetException> { resultWith("label" to null) }.targetException
        assertContains(refusal.message.orEmpty(), "parameter label")
    }

    @Test
    fun `an unsigned number out of range is refused`() {
        assertOutOfRange("mode is 256; it must be from 0 to 255") { resultWith("mode" to 256) }
        assertOutOfRange("maybe_mode is -1; it must be from 0 to 255") { resultWith("maybeMode" to -1) }
        val schema = GeneratedSchemas.of(
            "namespace test.unsigned; table SensorData { } struct ActuatorData { high: ushort; count: uint; }",
            "test.unsigned.UserSchema",
        )
        val create = schema.actuatorType.getConstructor(Int::class.java, Long::class.java)
        assertOutOfRange("high is 65536; it must be from 0 to 65535") { create.newInstance(65536, 0L) }
        assertOutOfRange("count is -1; it must be from 0 to 4294967295") { create.newInstance(0, -1L) }
        assertOutOfRange("count is 4294967296; it must be from 0 to 4294967295") { create.newInstance(0, 1L shl 32) }
        assertWritten(schema, arrayOf(create.newInstance(65535, 4294967295L)))
    }

    private fun assertOutOfRange(message: String, create: () -> Any) =
        assertEquals(message, assertFailsWith<InvocationTargetException> { create() }.targetException.message)

    @Test
    fun `a result that contains itself is refused, and the deepest allowed one is written`() {
        val all = type("TreeValue").constructors.single { it.parameterCount == 4 && !it.isSynthetic }
        val children = ArrayList<Any>()
        val round = all.newInstance(null, null, null, children)
        children += round
        val writer = GeneratedSchemas.features.actuatorWriter()
        val problem = assertNotNull(writer.findProblem(resultWith("tree" to round)))
        assertEquals("tree" + ".children[0]".repeat(63) + " is nested deeper than 64 tables", problem)
        var deep = all.newInstance(null, null, null, null)
        repeat(62) { deep = all.newInstance(null, null, deep, null) }
        val result = resultWith("tree" to deep)
        assertNull(writer.findProblem(result))
        write(GeneratedSchemas.features, arrayOf(result))
    }

    private fun type(name: String) = GeneratedSchemas.features.actuatorType.classLoader.loadClass("test.features.$name")

    private fun leaf(name: String) = type("LeafValue").getConstructor(String::class.java).newInstance(name)

    /** Returns a random result of the test schema `features`, in which one field has the given value. */
    private fun resultWith(field: Pair<String, Any?>): Any {
        val original = Objects.randomResult(GeneratedSchemas.features, random)
        val fields = original.javaClass.declaredFields.onEach { it.isAccessible = true }
        val values = fields.map { if (it.name == field.first) field.second else it.get(original) }
        return original.javaClass.constructors.single { it.parameterCount == fields.size }.newInstance(*values.toTypedArray())
    }

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
        assertNotNull(texts.find(pattern::matches), "none of $texts matches $pattern")

    private companion object {
        const val BLOCK_BYTES = 104
    }
}
