package org.collektive.frames

/**
 * The fields of one table, for [FrameChecker].
 *
 * Generated code builds it: each function adds a field and returns this layout. `entry` is the offset of the field in the vtable, in
 * bytes. Do not add fields once the layout is in use.
 */
public class TableLayout {
    internal val fields: MutableList<FieldLayout> = ArrayList()

    /** Whether no field references a table. */
    internal var isFlat: Boolean = true
        private set

    /** Adds a scalar, an enum or a struct of [bytes] bytes. */
    public fun inline(name: String, entry: Int, bytes: Int, required: Boolean): TableLayout =
        add(FieldLayout(name, entry, FieldKind.INLINE, bytes, null, required))

    /** Adds a string. */
    public fun string(name: String, entry: Int, required: Boolean): TableLayout =
        add(FieldLayout(name, entry, FieldKind.STRING, OFFSET_BYTES, null, required))

    /** Adds a table. */
    public fun table(name: String, entry: Int, layout: TableLayout, required: Boolean): TableLayout =
        add(FieldLayout(name, entry, FieldKind.TABLE, OFFSET_BYTES, layout, required))

    /** Adds a vector of scalars, enums or structs of [bytes] bytes each. */
    public fun vector(name: String, entry: Int, bytes: Int, required: Boolean): TableLayout =
        add(FieldLayout(name, entry, FieldKind.VECTOR, bytes, null, required))

    /** Adds a vector of strings. */
    public fun strings(name: String, entry: Int, required: Boolean): TableLayout =
        add(FieldLayout(name, entry, FieldKind.STRINGS, OFFSET_BYTES, null, required))

    /** Adds a vector of tables. */
    public fun tables(name: String, entry: Int, layout: TableLayout, required: Boolean): TableLayout =
        add(FieldLayout(name, entry, FieldKind.TABLES, OFFSET_BYTES, layout, required))

    private fun add(field: FieldLayout): TableLayout {
        fields.add(field)
        if (field.layout != null) isFlat = false
        return this
    }
}

internal enum class FieldKind { INLINE, STRING, TABLE, VECTOR, STRINGS, TABLES }

/** A field: [bytes] is the size of its value or of one vector element, [layout] the layout of the tables that it references. */
internal class FieldLayout(
    val name: String,
    val entry: Int,
    val kind: FieldKind,
    val bytes: Int,
    val layout: TableLayout?,
    val required: Boolean,
) {
    /** Size of the part that is stored in the table itself. */
    val bytesInTable: Int get() = if (kind == FieldKind.INLINE) bytes else OFFSET_BYTES
}

/** Size of an offset, and of the length of a vector, in bytes. */
public const val OFFSET_BYTES: Int = 4
