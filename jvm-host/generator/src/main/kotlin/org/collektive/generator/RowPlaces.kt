package org.collektive.generator

/**
 * Where the fields of a table lie when there is room for all of them: after the distance of the vtable, the largest alignments first. In bytes.
 *
 * C# gives a sequential struct of the same fields the same places.
 */
internal class RowPlaces(type: TableType) {
    /** Place by field, in the order of the places. */
    val offsets: Map<Field, Int>

    /** Of the row; never less than that of its vtable's distance. */
    val alignment: Int = type.fields.maxOfOrNull { alignment(it.type) }?.coerceAtLeast(OFFSET_BYTES) ?: OFFSET_BYTES

    /** Of the row, with the gap that an array of rows needs. */
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
