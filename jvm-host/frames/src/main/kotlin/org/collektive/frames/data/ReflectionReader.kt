package org.collektive.frames.data

import com.google.flatbuffers.reflection.BaseType
import com.google.flatbuffers.reflection.Field
import com.google.flatbuffers.reflection.Type
import org.collektive.frames.OFFSET_BYTES
import org.collektive.frames.TableLayout
import java.nio.ByteBuffer
import com.google.flatbuffers.reflection.Object as Composite

/**
 * Reads data of any type with the binary schema, for tools that compare or show data. It runs no generated code.
 *
 * Structs and tables become maps from field names to values, in the order of the schema. Vectors become lists. An absent field is `null`,
 * but an absent vector is an empty list, as in programs.
 *
 * @param binarySchema flatc's binary form of the schema.
 * @throws org.collektive.frames.MalformedFrameException when the schema is damaged.
 */
public class ReflectionReader(binarySchema: ByteArray) {
    private val schema = BinarySchema(binarySchema)

    /** Returns the qualified name of the type [simpleName], or `null` if no namespace of the schema defines it. */
    public fun find(simpleName: String): String? = schema.names.find { it.substringAfterLast('.') == simpleName }

    /**
     * Creates a reader of the table `Sensors` or `Actuators` with elements of [type].
     *
     * @throws org.collektive.frames.MalformedFrameException when the schema does not define [type], or is damaged there.
     */
    public fun elements(type: String): ElementReader = schema.elements(type)

    /**
     * Returns the layout of the table [type].
     *
     * @throws org.collektive.frames.MalformedFrameException when the schema does not define [type], or is damaged there.
     */
    public fun table(type: String): TableLayout = schema.table(type)

    /** Reads a value of the qualified [type] at [position] of [frame]. The data must have passed the check of its layout. */
    public fun read(type: String, frame: ByteBuffer, position: Int): Map<String, Any?> =
        read(checkNotNull(schema.find(type)) { "the schema does not define $type" }, frame, position)

    private fun read(type: Composite, frame: ByteBuffer, position: Int): Map<String, Any?> =
        List(type.fieldsLength(), type::fields).sortedBy(Field::id).filter { !it.deprecated() }.associate { field ->
            field.name() to if (type.isStruct) value(field.type(), frame, position + field.offset()) else field(field, frame, position)
        }

    private fun field(field: Field, frame: ByteBuffer, table: Int): Any? {
        val vtable = table - frame.getInt(table)
        val offset = if (field.offset() < unsigned(frame, vtable)) unsigned(frame, vtable + field.offset()) else 0
        return if (offset != 0) value(field.type(), frame, table + offset) else default(field)
    }

    private fun default(field: Field): Any? {
        val type = field.type().baseType()
        return when {
            type == BaseType.Vector -> emptyList<Any>()
            field.optional() || type == BaseType.String || type == BaseType.Obj -> null
            type == BaseType.Bool -> field.defaultInteger() != 0L
            type == BaseType.Float -> field.defaultReal().toFloat()
            type == BaseType.Double -> field.defaultReal()
            else -> field.defaultInteger()
        }
    }

    private fun value(type: Type, frame: ByteBuffer, at: Int): Any = when (type.baseType()) {
        BaseType.String -> string(frame, at + frame.getInt(at))
        BaseType.Vector -> vector(type, frame, at + frame.getInt(at))
        BaseType.Obj -> composite(type, frame, at)
        else -> scalar(type.baseType(), frame, at)
    }

    private fun composite(type: Type, frame: ByteBuffer, at: Int): Any {
        val composite = schema.composite(type)
        return read(composite, frame, if (composite.isStruct) at else at + frame.getInt(at))
    }

    private fun vector(type: Type, frame: ByteBuffer, at: Int): List<Any> {
        val first = at + OFFSET_BYTES
        return List(frame.getInt(at)) { index ->
            val place = first + index * type.elementSize().toInt()
            when (type.element()) {
                BaseType.String -> string(frame, place + frame.getInt(place))
                BaseType.Obj -> composite(type, frame, place)
                else -> scalar(type.element(), frame, place)
            }
        }
    }

    private fun string(frame: ByteBuffer, at: Int): String {
        val bytes = ByteArray(frame.getInt(at))
        frame.get(at + OFFSET_BYTES, bytes)
        return bytes.decodeToString()
    }

    private fun scalar(base: Byte, frame: ByteBuffer, at: Int): Any = when (base) {
        BaseType.Bool -> frame.get(at) != 0.toByte()
        BaseType.Byte -> frame.get(at).toLong()
        BaseType.UByte -> frame.get(at).toUByte().toLong()
        BaseType.Short -> frame.getShort(at).toLong()
        BaseType.UShort -> frame.getShort(at).toUShort().toLong()
        BaseType.Int -> frame.getInt(at).toLong()
        BaseType.UInt -> frame.getInt(at).toUInt().toLong()
        BaseType.Float -> frame.getFloat(at)
        BaseType.Double -> frame.getDouble(at)
        else -> frame.getLong(at)
    }

    private fun unsigned(frame: ByteBuffer, at: Int): Int = frame.getShort(at).toUShort().toInt()

    public companion object {
        /** Returns the name of the jar entry with the binary form of the schema [name]. */
        public fun entry(name: String): String = "META-INF/collektive/$name.bfbs"
    }
}
