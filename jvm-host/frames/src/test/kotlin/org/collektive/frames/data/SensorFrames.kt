package org.collektive.frames.data

import com.google.flatbuffers.FlatBufferBuilder
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.util.Random

/** A frame in the format that C# writes, with the [position] of its table and its content as [objects]. */
internal class Frame(val bytes: ByteArray, val position: Int, val objects: List<Any>) {
    fun buffer(): ByteBuffer = ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN)
}

internal object SensorFrames {
    /** Returns a table `Sensors` with random elements. They are structs of [structBytes] bytes, or tables if [structBytes] is `null`. */
    fun sensors(schema: DataSchema, count: Int, random: Random, structBytes: Int? = null, alignment: Int = 8): Frame {
        val reader = GeneratedSchemas.flatc(schema, schema.sensorType.name)
        val type = GeneratedSchemas.flatc(schema, "${schema.sensorType.name}T")
        val objects = List(count) { Objects.random(type, random) }
        val builder = FlatBufferBuilder(64)
        val vector = if (structBytes == null) {
            builder.createVectorOfTables(objects.map { pack(builder, reader, it) }.toIntArray())
        } else {
            builder.startVector(structBytes, count, alignment)
            objects.asReversed().forEach { pack(builder, reader, it) }
            builder.endVector()
        }
        builder.startTable(1)
        builder.addOffset(0, vector, 0)
        return finish(builder, builder.endTable(), objects)
    }

    /** Returns a random table of the [type] of the schema. */
    fun table(schema: DataSchema, type: String, random: Random): Frame {
        val content = Objects.random(GeneratedSchemas.flatc(schema, "${type}T"), random)
        val builder = FlatBufferBuilder(64)
        return finish(builder, pack(builder, GeneratedSchemas.flatc(schema, type), content), listOf(content))
    }

    private fun pack(builder: FlatBufferBuilder, reader: Class<*>, data: Any): Int =
        reader.getMethod("pack", FlatBufferBuilder::class.java, data.javaClass).invoke(null, builder, data) as Int

    private fun finish(builder: FlatBufferBuilder, table: Int, objects: List<Any>): Frame {
        builder.finish(table)
        val bytes = builder.sizedByteArray()
        return Frame(bytes, bytes.size - table, objects)
    }
}
