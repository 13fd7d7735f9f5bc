package org.collektive.host

import com.google.flatbuffers.Utf8
import java.nio.ByteBuffer
import java.nio.ByteOrder

/**
 * Checks that all of a frame of `frame.fbs` can be read without leaving it, before anything of it is used.
 *
 * Strings may be shared between tables. The number of tables is bounded by the frame's length, so a frame that leads to one
 * table from everywhere costs no more than an honest one. User data is left to generated code.
 */
internal class FrameVerifier {
    private var frame: ByteBuffer = ByteBuffer.allocate(0)
    private var begin = 0
    private var end = 0
    private var tablesLeft = 0

    /** Checks [frame], from its position to its limit, as [shape] and returns the position of its root table. */
    fun verify(frame: ByteBuffer, shape: Shape): Int {
        this.frame = frame
        begin = frame.position()
        end = frame.limit()
        tablesLeft = frame.remaining()
        val root = target(begin, "the root")
        table(root, shape, shape.name)
        return root
    }

    /** Where the table or vector in the field [index] of the verified [table] lies; 0 when the field is absent. */
    fun target(table: Int, index: Int): Int {
        val vtable = table - frame.getInt(table)
        val entry = OFFSET + 2 * index
        val at = if (entry < (frame.getShort(vtable).toInt() and USHORT)) frame.getShort(vtable + entry).toInt() and USHORT else 0
        return if (at == 0) 0 else target(table + at, "a field")
    }

    private fun table(position: Int, shape: Shape, path: String) {
        if (--tablesLeft < 0) damaged(path, "shares its bytes with too many others")
        require(position, OFFSET, path)
        val vtable = position.toLong() - frame.getInt(position)
        if (vtable < begin || vtable > end - OFFSET) damaged(path, "has its vtable outside")
        val vtableSize = frame.getShort(vtable.toInt()).toInt() and USHORT
        val tableSize = frame.getShort(vtable.toInt() + 2).toInt() and USHORT
        require(vtable.toInt(), vtableSize, path)
        require(position, tableSize, path)
        if (vtableSize < OFFSET || vtableSize % 2 != 0) damaged(path, "has a vtable of $vtableSize bytes")
        for (index in shape.fields.indices) {
            val field = shape.fields[index]
            val entry = OFFSET + 2 * index
            val at = if (entry < vtableSize) frame.getShort(vtable.toInt() + entry).toInt() and USHORT else 0
            if (at == 0) {
                if (field.isRequired) damaged(path, "has no ${field.name}")
                continue
            }
            if (at < OFFSET || at + field.size > tableSize) damaged(path, "has ${field.name} outside")
            field(position + at, field, path)
        }
    }

    private fun field(position: Int, field: Field, path: String) {
        when (field.kind) {
            Kind.INLINE -> {}
            Kind.OPAQUE -> target(position, field.name)
            Kind.TABLE -> table(target(position, field.name), checkNotNull(field.shape), "$path.${field.name}")
            Kind.STRING -> string(target(position, field.name), field.name)
            Kind.VECTOR -> vector(target(position, field.name), field.elementSize, field.name)
            Kind.STRINGS, Kind.TABLES -> {
                val vector = target(position, field.name)
                val count = vector(vector, OFFSET, field.name)
                for (index in 0 until count) {
                    val element = target(vector + OFFSET + index * OFFSET, field.name)
                    val shape = field.shape
                    if (shape == null) string(element, field.name) else table(element, shape, "$path.${field.name}")
                }
            }
        }
    }

    private fun string(position: Int, path: String) {
        val length = vector(position, 1, path)
        if (length > MAX_STRING) damaged(path, "is a string of $length bytes, more than $MAX_STRING")
        try {
            Utf8.getDefault().decodeUtf8(frame, position + OFFSET, length)
        } catch (_: IllegalArgumentException) {
            damaged(path, "is a string that is not UTF-8")
        }
    }

    private fun vector(position: Int, elementSize: Int, path: String): Int {
        require(position, OFFSET, path)
        val count = frame.getInt(position)
        if (count < 0 || position + OFFSET + count.toLong() * elementSize > end) damaged(path, "has $count elements, more than fit")
        return count
    }

    private fun target(position: Int, path: String): Int {
        require(position, OFFSET, path)
        val target = position + (frame.getInt(position).toLong() and UINT)
        if (target == position.toLong() || target > end - OFFSET) damaged(path, "lies outside")
        return target.toInt()
    }

    private fun require(position: Int, size: Int, path: String) {
        if (position < begin || position.toLong() + size > end) damaged(path, "lies outside")
    }

    private fun damaged(path: String, what: String): Nothing = throw HostException(HostError.FRAME, "the frame is damaged: $path $what")

    /** The fields of a table in id order. */
    class Shape(val name: String, vararg val fields: Field)

    class Field(
        val name: String,
        val kind: Kind,
        val size: Int = OFFSET,
        val elementSize: Int = 0,
        val shape: Shape? = null,
        val isRequired: Boolean = false,
    )

    enum class Kind { INLINE, OPAQUE, TABLE, STRING, VECTOR, STRINGS, TABLES }

    companion object {
        private const val OFFSET = 4
        private const val USHORT = 0xFFFF
        private const val UINT = 0xFFFF_FFFFL
        private const val MAX_STRING = 0xFFFF

        /** The bytes [offset] until [offset] + [length] of [buffer] as position and limit of it. */
        fun frame(buffer: ByteBuffer, offset: Int, length: Int): ByteBuffer {
            if (offset < 0 || length < OFFSET || offset.toLong() + length > buffer.capacity()) {
                throw HostException(
                    HostError.FRAME,
                    "the frame (bytes $offset to ${offset.toLong() + length}) does not lie in its slot of ${buffer.capacity()} bytes",
                )
            }
            return buffer.clear().position(offset).limit(offset + length).order(ByteOrder.LITTLE_ENDIAN)
        }

        fun inline(name: String, size: Int) = Field(name, Kind.INLINE, size)

        fun opaque(name: String) = Field(name, Kind.OPAQUE)

        fun table(name: String, shape: Shape) = Field(name, Kind.TABLE, shape = shape)

        fun string(name: String, isRequired: Boolean = false) = Field(name, Kind.STRING, isRequired = isRequired)

        fun vector(name: String, elementSize: Int) = Field(name, Kind.VECTOR, elementSize = elementSize)

        fun strings(name: String) = Field(name, Kind.STRINGS, isRequired = true)

        fun tables(name: String, shape: Shape, isRequired: Boolean = false) =
            Field(name, Kind.TABLES, shape = shape, isRequired = isRequired)
    }
}
