package org.collektive.frames

import java.nio.ByteBuffer

/**
 * A cached vtable that has been verified. The tables of a tick share a few vtables, so most tables need only their strings and vectors
 * checked. Only for flat layouts, whose check never re-enters this cache.
 */
internal class VerifiedVtable {
    private var layout: TableLayout? = null
    private var vtable = 0L
    private var fields = arrayOfNulls<FieldLayout>(0)
    private var places = IntArray(0)

    /** Bytes from the start of such a table to the end of its last field. */
    var extent = 0L
        private set

    /** Number of fields that are stored as offsets. */
    var count = 0
        private set

    fun matches(vtable: Long, layout: TableLayout): Boolean = vtable == this.vtable && layout === this.layout

    fun field(index: Int): FieldLayout = fields[index] ?: error("no field $index of $count")

    /** Returns the offset of field [index] from the start of a table, in bytes. */
    fun place(index: Int): Int = places[index]

    /** Invalidates this entry. Call it for each new frame. */
    fun invalidate() {
        layout = null
    }

    fun store(frame: ByteBuffer, vtable: Int, layout: TableLayout) {
        this.vtable = vtable.toLong()
        this.layout = layout
        extent = 0
        count = 0
        if (places.size < layout.fields.size) {
            fields = arrayOfNulls(layout.fields.size)
            places = IntArray(layout.fields.size)
        }
        val vtableBytes = frame.getShort(vtable).toInt()
        for (index in layout.fields.indices) {
            val field = layout.fields[index]
            val place = if (field.entry < vtableBytes) frame.getShort(vtable + field.entry).toInt() else 0
            if (place == 0) continue
            extent = maxOf(extent, place.toLong() + field.bytesInTable)
            if (field.kind == FieldKind.INLINE) continue
            fields[count] = field
            places[count++] = place
        }
    }
}
