package org.collektive.frames.data

import com.google.flatbuffers.reflection.BaseType
import com.google.flatbuffers.reflection.Field
import com.google.flatbuffers.reflection.Schema
import com.google.flatbuffers.reflection.Type
import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.OFFSET_BYTES
import org.collektive.frames.TableLayout
import java.nio.ByteBuffer
import java.nio.ByteOrder
import com.google.flatbuffers.reflection.Object as Composite

/**
 * Validates flatc's binary schema and builds the layouts of its types.
 *
 * Data that passes the check of such a layout can be read without exceptions, so neither schema nor data need to be trusted.
 */
internal class BinarySchema(bytes: ByteArray) {
    private val schema: Schema
    private val tables = HashMap<Int, TableLayout>()
    private val structs = HashMap<Int, Int>()
    private val incomplete = ArrayDeque<Int>()

    init {
        val buffer = ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN)
        FrameChecker(FramePolicy.FRAME).checkRoot(buffer, SCHEMA)
        schema = Schema.getRootAsSchema(buffer)
    }

    /** The qualified names of all structs and tables. */
    val names: List<String> get() = List(schema.objectsLength()) { schema.objects(it).name() }

    /** Returns the struct or table with the qualified [name], or `null` if the schema does not define it. */
    fun find(name: String): Composite? = indexOf(name)?.let(schema::objects)

    /** Returns the struct or table of [type], or of the elements of a vector [type]. */
    fun composite(type: Type): Composite = schema.objects(type.index())

    /** Returns the layout of the table [name]. */
    fun table(name: String): TableLayout = completed(table(index(name)))

    /** Creates a reader of the table `Sensors` or `Actuators` with elements of type [name]. */
    fun elements(name: String): ElementReader {
        val index = index(name)
        return if (schema.objects(index).isStruct) ElementReader(struct(index, 0)) else ElementReader(table(name))
    }

    private fun indexOf(name: String): Int? = (0 until schema.objectsLength()).find { schema.objects(it).name() == name }

    private fun index(name: String): Int = indexOf(name) ?: throw MalformedFrameException("the schema does not define $name")

    private fun table(index: Int): TableLayout = tables.getOrPut(index) { TableLayout().also { incomplete.addLast(index) } }

    /** Adds the fields of incomplete tables iteratively, because tables reference each other in chains and cycles of any length. */
    private fun completed(layout: TableLayout): TableLayout {
        while (true) {
            val index = incomplete.removeFirstOrNull() ?: return layout
            val table = schema.objects(index)
            for (field in List(table.fieldsLength(), table::fields)) {
                if (!field.deprecated()) add(tables.getValue(index), field, "${table.name()}.${field.name()}")
            }
        }
    }

    private fun add(layout: TableLayout, field: Field, place: String) {
        val name = field.name()
        val entry = field.offset()
        val isRequired = field.required()
        val type = field.type()
        when (type.baseType()) {
            BaseType.String -> layout.string(name, entry, isRequired)

            BaseType.Obj -> if (composite(type, place).isStruct) {
                layout.inline(name, entry, struct(type.index(), 0), isRequired)
            } else {
                layout.table(name, entry, table(type.index()), isRequired)
            }

            BaseType.Vector -> addVector(layout, field, place)

            else -> layout.inline(name, entry, scalar(type.baseType(), place), isRequired)
        }
        if (entry < FIRST_ENTRY || entry % 2 != 0) throw damaged(place)
    }

    private fun addVector(layout: TableLayout, field: Field, place: String) {
        val type = field.type()
        val isStructs = type.element() == BaseType.Obj && composite(type, place).isStruct
        val bytes = when {
            isStructs -> struct(type.index(), 0)
            type.element() == BaseType.String || type.element() == BaseType.Obj -> OFFSET_BYTES
            else -> scalar(type.element(), place)
        }
        if (type.elementSize() != bytes.toLong()) throw damaged(place)
        when {
            type.element() == BaseType.String -> layout.strings(field.name(), field.offset(), field.required())

            type.element() == BaseType.Obj && !isStructs -> layout.tables(
                field.name(),
                field.offset(),
                table(type.index()),
                field.required(),
            )

            else -> layout.vector(field.name(), field.offset(), bytes, field.required())
        }
    }

    /** Returns the size of a struct in bytes. Checks that its fields lie inside it and do not overlap, so a struct cannot contain itself. */
    private fun struct(index: Int, depth: Int): Int = structs[index] ?: run {
        val struct = schema.objects(index)
        if (!struct.isStruct || depth > MAX_DEPTH) throw damaged(struct.name())
        var end = 0
        for (field in List(struct.fieldsLength(), struct::fields).sortedBy(Field::id)) {
            val place = "${struct.name()}.${field.name()}"
            val type = field.type()
            if (type.baseType() == BaseType.Obj) composite(type, place)
            val bytes = if (type.baseType() == BaseType.Obj) struct(type.index(), depth + 1) else scalar(type.baseType(), place)
            if (field.offset() < end) throw damaged(place)
            end = field.offset() + bytes
        }
        if (end == 0 || end > struct.bytesize()) throw damaged(struct.name())
        struct.bytesize().also { structs[index] = it }
    }

    private fun composite(type: Type, place: String): Composite {
        if (type.index() !in 0 until schema.objectsLength()) throw damaged(place)
        return composite(type)
    }

    private fun scalar(base: Byte, place: String): Int = when (base) {
        BaseType.Bool, BaseType.Byte, BaseType.UByte -> Byte.SIZE_BYTES
        BaseType.Short, BaseType.UShort -> Short.SIZE_BYTES
        BaseType.Int, BaseType.UInt, BaseType.Float -> Int.SIZE_BYTES
        BaseType.Long, BaseType.ULong, BaseType.Double -> Long.SIZE_BYTES
        else -> throw damaged(place)
    }

    private fun damaged(place: String) = MalformedFrameException("the binary schema is damaged at $place")

    private companion object {
        const val FIRST_ENTRY = 4
        const val MAX_DEPTH = 64

        /** The fields of flatc's `reflection.fbs` that this class reads. */
        val TYPE: TableLayout = TableLayout().inline("base_type", 4, 1, false).inline("element", 6, 1, false).inline("index", 8, 4, false)
            .inline("element_size", 14, 4, false)
        val FIELD: TableLayout = TableLayout().string("name", 4, true).table("type", 6, TYPE, true).inline("id", 8, 2, false)
            .inline("offset", 10, 2, false).inline("default_integer", 12, 8, false).inline("default_real", 14, 8, false)
            .inline("deprecated", 16, 1, false).inline("required", 18, 1, false).inline("optional", 26, 1, false)
        val OBJECT: TableLayout = TableLayout().string("name", 4, true).tables("fields", 6, FIELD, true).inline("is_struct", 8, 1, false)
            .inline("bytesize", 12, 4, false)
        val SCHEMA: TableLayout = TableLayout().tables("objects", 4, OBJECT, true)
    }
}
