package org.collektive.frames.data

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.frames.OFFSET_BYTES
import java.nio.ByteBuffer

/** Writes the table `Actuators` of a frame. Created by generated code. [findProblem] is thread-safe. */
public sealed class ActuatorWriter(private val type: Class<*>) {
    /**
     * Returns why [result] cannot be written, with the path of the field (`words[1] is null`), or `null` if it can.
     *
     * Check each result after its round, because one invalid result corrupts the whole answer.
     */
    public fun findProblem(result: Any?): String? = when {
        result == null -> "the program returned null"
        !type.isInstance(result) -> "the program returned a ${result.javaClass.name} instead of a ${type.name}"
        else -> problem(result)
    }

    internal abstract fun problem(result: Any): String?

    internal fun table(builder: FlatBufferBuilder, vector: Int): Int {
        builder.startTable(1)
        builder.addOffset(DATA_SLOT, vector, 0)
        return builder.endTable()
    }

    private companion object {
        /** Slot of the only field of `Actuators`. */
        const val DATA_SLOT = 0
    }
}

/** Writes results that are structs of [bytes] bytes with alignment [alignment]. Stateless. */
public class StructWriter(type: Class<*>, public val bytes: Int, private val alignment: Int, private val packer: Packer) :
    ActuatorWriter(type) {
    /** Writes one struct; generated code implements it. */
    public fun interface Packer {
        /** Writes the fields of [result] to [target] at [place]. Leaves padding bytes unchanged. */
        public fun pack(target: ByteBuffer, place: Int, result: Any)
    }

    override fun problem(result: Any): String? = null

    /**
     * Writes the valid [result] to [target], which is little-endian, at [place]. The bytes there must be zero or an earlier result.
     */
    public fun pack(target: ByteBuffer, place: Int, result: Any): Unit = packer.pack(target, place, result)

    /** Writes the first [count] structs of [packed], which is contiguous and little-endian. Returns the table's offset in [builder]. */
    public fun write(builder: FlatBufferBuilder, packed: ByteBuffer, count: Int): Int {
        builder.startVector(bytes, count, alignment)
        // FlatBufferBuilder copies blocks only into vectors of bytes, so this copies words.
        var at = count * bytes
        while (at >= Long.SIZE_BYTES) {
            at -= Long.SIZE_BYTES
            builder.putLong(packed.getLong(at))
        }
        while (at > 0) builder.putByte(packed.get(--at))
        return table(builder, builder.endVector())
    }
}

/** Writes results that are tables. */
public class TableWriter(type: Class<*>, private val packer: Packer, private val rule: Rule) : ActuatorWriter(type) {
    /** Writes one table; generated code implements it. */
    public fun interface Packer {
        /** Writes [result], children first, and returns its offset in [builder]. */
        public fun pack(builder: FlatBufferBuilder, result: Any): Int
    }

    /** Validates results that have the right class; generated code implements it. */
    public fun interface Rule {
        /** Returns why [result] cannot be written, or `null` if it can. */
        public fun problem(result: Any): String?
    }

    private var offsets = IntArray(0)

    override fun problem(result: Any): String? = rule.problem(result)

    /**
     * Writes the first [count] of [results], in order, and returns the table's offset in [builder]. All of them must be valid.
     *
     * Fills [ranges] for the digest: `ranges[2 * i]` is the distance of the first byte of element i from the *end* of the builder's
     * buffer, `ranges[2 * i + 1]` its length, both in bytes.
     */
    public fun write(builder: FlatBufferBuilder, results: Array<Any?>, count: Int, ranges: IntArray): Int {
        if (offsets.size < count) offsets = IntArray(maxOf(count, 2 * offsets.size))
        for (i in 0 until count) {
            val before = builder.offset()
            offsets[i] = packer.pack(builder, requireNotNull(results[i]) { "result $i is null" })
            ranges[2 * i] = builder.offset()
            ranges[2 * i + 1] = builder.offset() - before
        }
        builder.startVector(OFFSET_BYTES, count, OFFSET_BYTES)
        for (i in count - 1 downTo 0) builder.addOffset(offsets[i])
        return table(builder, builder.endVector())
    }
}
