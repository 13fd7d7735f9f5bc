package org.collektive.frames.data

import com.google.flatbuffers.FlatBufferBuilder
import java.io.DataInputStream
import java.io.DataOutputStream
import java.io.File
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.util.Random

/**
 * The Kotlin half of `schema/test/test_roundtrip.py`.
 *
 * It compares sensor and global data that C# wrote, and writes random actuator data for C#. Both halves use one file per schema. The
 * schemas are a comma-separated argument.
 */
internal object RoundTrip {
    @JvmStatic
    fun main(arguments: Array<String>) {
        for (name in arguments[1].split(',')) {
            val schema = Class.forName(name).getConstructor().newInstance() as DataSchema
            val file = File("${arguments[2]}.$name")
            if (arguments[0] == "write") write(schema, file, arguments[3].toInt(), arguments[4].toLong()) else read(schema, file)
        }
    }

    private fun read(schema: DataSchema, file: File) {
        val sensors = schema.sensorReader()
        val globals = schema.globalReader()
        val reflection = reflectionReader(schema)
        var passed = 0
        var failed = 0
        DataInputStream(file.inputStream().buffered()).use { input ->
            for (name in listOf("SensorData", "ActuatorData", "GlobalData").filter { it in schema.types }) {
                val hash = java.lang.Long.reverseBytes(input.readLong())
                check(hash == schema.types[name]) { "the fingerprint of $name differs in C#" }
            }
            while (input.available() > 0) {
                val positions = List(3) { input.readLittle() }
                val frame = ByteBuffer.wrap(input.readNBytes(input.readLittle())).order(ByteOrder.LITTLE_ENDIAN)
                val expected = input.readNBytes(input.readLittle()).decodeToString()
                val text = StringBuilder()
                sensors.attach(frame, positions[0])
                sensors.check()
                for (i in 0 until sensors.size) {
                    text.append(
                        Objects.dump(reflection.read(schema.sensorType.name, frame, sensors.place(i))),
                    ).append('\n')
                }
                if (globals != null) {
                    globals.attach(frame, positions[1])
                    globals.check()
                    text.append(Objects.dump(reflection.read(globals.data.javaClass.name, frame, positions[1]))).append('\n')
                }
                if (sensors.size == positions[2] && text.toString() == expected) {
                    passed++
                } else if (failed++ == 0) {
                    System.err.println("record $passed of $file\nexpected $expected\nread     $text")
                }
            }
        }
        println("${schema.name}: C# to Kotlin: $passed passed, $failed failed")
    }

    private fun write(schema: DataSchema, file: File, records: Int, seed: Long) {
        val random = Random(seed)
        val writer = schema.actuatorWriter()
        DataOutputStream(file.outputStream().buffered()).use { output ->
            repeat(records) {
                val count = random.nextInt(6)
                val results = Array<Any?>(count) { Objects.randomResult(schema, random) }
                results.forEach { result -> check(writer.findProblem(result) == null) { "${writer.findProblem(result)}" } }
                val builder = FlatBufferBuilder(256)
                val offset = writer.writeAll(builder, results)
                builder.finish(offset)
                val frame = builder.sizedByteArray()
                val text = results.joinToString("") { Objects.dump(it) + "\n" }.encodeToByteArray()
                for (number in listOf(frame.size - offset, -1, count, frame.size)) output.writeLittle(number)
                output.write(frame)
                output.writeLittle(text.size)
                output.write(text)
            }
        }
    }

    private fun DataInputStream.readLittle(): Int = Integer.reverseBytes(readInt())

    private fun DataOutputStream.writeLittle(value: Int) = writeInt(Integer.reverseBytes(value))
}

/** Writes [results] as the answers of a tick, and the ranges of tables to [ranges]. Returns the position of the table `Actuators`. */
internal fun ActuatorWriter.writeAll(
    builder: FlatBufferBuilder,
    results: Array<Any?>,
    ranges: IntArray = IntArray(2 * results.size),
): Int = when (this) {
    is TableWriter -> write(builder, results, results.size, ranges)

    is StructWriter -> {
        val packed = ByteBuffer.allocate(results.size * bytes).order(ByteOrder.LITTLE_ENDIAN)
        results.forEachIndexed { i, result -> pack(packed, i * bytes, checkNotNull(result)) }
        write(builder, packed, results.size)
    }
}
