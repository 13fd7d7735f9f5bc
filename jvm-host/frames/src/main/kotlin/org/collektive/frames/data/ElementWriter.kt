package org.collektive.frames.data

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.frames.OFFSET_BYTES
import java.nio.ByteBuffer

/** Writes the table `Actuators` of any schema. Generated code makes it. */
public abstract class ElementWriter private constructor(private val type: Class<*>, private val rule: Rule) : ActuatorWriter {
    /** Writes one result; implemented by `pack` of generated code. */
    public fun interface Packer {
        /** Writes [result], children first, and returns its offset in [builder]. */
        public fun pack(builder: FlatBufferBuilder, result: Any): Int
    }

    /** Finds faults of results that have the right class. */
    public fun interface Rule {
        /** The reason why [result] cannot be written; `null` when it can. */
        public fun fault(result: Any): String?
    }

    override fun findFault(result: Any?): String? = when {
        result == null -> "the result is null"
        !type.isInstance(result) -> "the result is a ${result.javaClass.name}, not a ${type.name}"
        else -> rule.fault(result)
    }

    override fun write(builder: FlatBufferBuilder, results: Array<Any?>, count: Int, ranges: IntArray): Int =
        table(builder, writeElements(builder, results, count, ranges))

    internal fun table(builder: FlatBufferBuilder, vector: Int): Int {
        builder.startTable(1)
        builder.addOffset(DATA_SLOT, vector, 0)
        return builder.endTable()
    }

    internal abstract fun writeElements(builder: FlatBufferBuilder, results: Array<Any?>, count: Int, ranges: IntArray): Int

    internal fun result(results: Array<Any?>, index: Int): Any = results[index] ?: throw IllegalArgumentException("result $index is null")

    private class Structs(
        type: Class<*>,
        override val structBytes: Int,
        private val alignment: Int,
        private val packer: Packer,
        rule: Rule,
    ) : ElementWriter(type, rule) {
        // One struct is built here, then copied to its place. A builder reserves up to one alignment more than it uses.
        private val workplace = ByteBuffer.allocate(structBytes + alignment)
        private val single = FlatBufferBuilder(workplace)

        override fun pack(result: Any, target: ByteArray, offset: Int) {
            single.clear()
            packer.pack(single, result)
            System.arraycopy(workplace.array(), alignment, target, offset, structBytes)
        }

        override fun writePacked(builder: FlatBufferBuilder, packed: ByteBuffer, count: Int): Int {
            builder.startVector(structBytes, count, alignment)
            // FlatBufferBuilder copies blocks only into vectors of bytes, so copy words.
            var at = count * structBytes
            while (at >= Long.SIZE_BYTES) {
                at -= Long.SIZE_BYTES
                builder.putLong(packed.getLong(at))
            }
            while (at > 0) builder.putByte(packed.get(--at))
            return table(builder, builder.endVector())
        }

        override fun writeElements(builder: FlatBufferBuilder, results: Array<Any?>, count: Int, ranges: IntArray): Int {
            builder.startVector(structBytes, count, alignment)
            for (i in count - 1 downTo 0) {
                packer.pack(builder, result(results, i))
                ranges[2 * i] = builder.offset()
                ranges[2 * i + 1] = structBytes
            }
            return builder.endVector()
        }
    }

    private class Tables(type: Class<*>, private val packer: Packer, rule: Rule) : ElementWriter(type, rule) {
        private var offsets = IntArray(0)

        override val structBytes: Int get() = 0

        override fun pack(result: Any, target: ByteArray, offset: Int) = throw UnsupportedOperationException("tables vary in length")

        override fun writePacked(builder: FlatBufferBuilder, packed: ByteBuffer, count: Int) =
            throw UnsupportedOperationException("tables vary in length")

        override fun writeElements(builder: FlatBufferBuilder, results: Array<Any?>, count: Int, ranges: IntArray): Int {
            if (offsets.size < count) offsets = IntArray(maxOf(count, 2 * offsets.size))
            for (i in 0 until count) {
                val before = builder.offset()
                offsets[i] = packer.pack(builder, result(results, i))
                ranges[2 * i] = builder.offset()
                ranges[2 * i + 1] = builder.offset() - before
            }
            builder.startVector(OFFSET_BYTES, count, OFFSET_BYTES)
            for (i in count - 1 downTo 0) builder.addOffset(offsets[i])
            return builder.endVector()
        }
    }

    public companion object {
        /** Slot of the only field of `Actuators`. */
        private const val DATA_SLOT = 0

        /** Makes a writer for an `ActuatorData` that is a struct of [bytes] bytes; [type] is its object class. */
        @JvmStatic
        public fun structs(type: Class<*>, bytes: Int, alignment: Int, packer: Packer, rule: Rule): ActuatorWriter =
            Structs(type, bytes, alignment, packer, rule)

        /** Makes a writer for an `ActuatorData` that is a table; [type] is its object class. */
        @JvmStatic
        public fun tables(type: Class<*>, packer: Packer, rule: Rule): ActuatorWriter = Tables(type, packer, rule)
    }
}
