package org.collektive.generator

/**
 * The layout of a table's row, in bytes. A row has room for all fields. It starts with the vtable offset, followed by the fields by
 * descending alignment.
 *
 * A sequential C# struct with the same fields has the same layout.
 */
internal class RowPlaces(type: TableType) {
    /** Offset of each field, in ascending order. */
    val offsets: Map<Field, Int>

    /** Alignment of the row, which is at least the alignment of the vtable offset. */
    val alignment: Int = type.fields.maxOfOrNull { alignment(it.type) }?.coerceAtLeast(OFFSET_BYTES) ?: OFFSET_BYTES

    /** Size of the row, with the padding for an array of rows. */
    val bytes: Int

    init {
        var end = OFFSET_BYTES
        offsets = type.fields.sortedWith(compareBy({ -alignment(it.type) }, Field::id)).associateWith { field ->
            aligned(end, alignment(field.type)).also { end = it + bytes(field.type) }
        }
        bytes = aligned(end, alignment)
    }

    companion object {
        private const val OFFSET_BYTES = 4

        fun alignment(type: Type): Int = if (type is StructType) type.alignment else bytes(type)

        private fun bytes(type: Type): Int = when (type) {
            is Scalar -> type.bytes
            is EnumType -> type.underlying.bytes
            is StructType -> type.bytes
            else -> OFFSET_BYTES
        }

        private fun aligned(at: Int, alignment: Int) = (at + alignment - 1) / alignment * alignment
    }
}
