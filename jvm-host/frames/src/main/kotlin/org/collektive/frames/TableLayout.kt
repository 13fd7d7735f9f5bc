package org.collektive.frames

/**
 * Where the fields of one table lie, for [FrameChecker]. Made by generated code: each function adds a field and returns this
 * layout; `entry` is the field's place in the vtable, in bytes. Immutable once made.
 */
public class TableLayout {
    internal val fields: MutableList<FieldLayout> = ArrayList()

    /** Whether it leads to no further tables. */
    internal var isFlat: Boolean = true
        private set

    /** A scalar, an enum or a struct of [bytes] bytes. */
    public fun inline(name: String, entry: Int, bytes: Int, required: Boolean): TableLayout =
        add(FieldLayout(name, entry, FieldKind.INLINE, bytes, null, required))

    /** A string. */
    public fun string(name: String, entry: Int, required: Boolean): TableLayout =
        add(FieldLayout(name, entry, FieldKind.STRING, OFFSET_BYTES, null, required))

    /** A table. */
    public fun table(name: String, entry: Int, layout: TableLayout, required: Boolean): TableLayout =
        add(FieldLayout(name, entry, FieldKind.TABLE, OFFSET_BYTES, layout, required))

    /** A vector of scalars, enums or structs of [bytes] bytes each. */
    public fun vector(name: String, entry: Int, bytes: Int, required: Boolean): TableLayout =
        add(FieldLayout(name, entry, FieldKind.VECTOR, bytes, null, required))

    /** A vector of strings. */
    public fun strings(name: String, entry: Int, required: Boolean): TableLayout =
        add(FieldLayout(name, entry, FieldKind.STRINGS, OFFSET_BYTES, null, required))

    /** A vector of tables. */
    public fun tables(name: String, entry: Int, layout: TableLayout, required: Boolean): TableLayout =
        add(FieldLayout(name, entry, FieldKind.TABLES, OFFSET_BYTES, layout, required))

    private fun add(field: FieldLayout): TableLayout {
        fields.add(field)
        if (field.layout != null) isFlat = false
        return this
    }
}

internal enum class FieldKind { INLINE, STRING, TABLE, VECTOR, STRINGS, TABLES }

/** [bytes]: of the value itself, or of one element of a vector. [layout]: of the table or tables it leads to. */
internal class FieldLayout(
    val name: String,
    val entry: Int,
    val kind: FieldKind,
    val bytes: Int,
    val layout: TableLayout?,
    val required: Boolean,
) {
    /** Of what stands in the table itself. */
    val bytesInTable: Int get() = if (kind == FieldKind.INLINE) bytes else OFFSET_BYTES
}

/** Size of an offset, and of the length of a vector. */
public const val OFFSET_BYTES: Int = 4
