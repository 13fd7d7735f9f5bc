package org.collektive.frames

import java.nio.ByteBuffer

/**
 * A verified vtable. The tables of a tick share a few vtables, so most tables need only their strings and vectors checked. For flat
 * layouts only: checking one never re-enters this cache.
 */
internal class KnownTable {
    private var layout: TableLayout? = null
    private var vtable = 0L
    private var fields = arrayOfNulls<FieldLayout>(0)
    private var places = IntArray(0)

    /** Bytes from the start of such a table to the end of its last field. */
    var reach = 0L
        private set

    /** Number of fields that are offsets. */
    var count = 0
        private set

    fun isOf(vtable: Long, layout: TableLayout): Boolean = vtable == this.vtable && layout === this.layout

    fun field(index: Int): FieldLayout = fields[index] ?: error("no field $index of $count")

    /** Offset of the field [index] from the start of a table, in bytes. */
    fun place(index: Int): Int = places[index]

    /** Invalidates this entry. Call it for each new frame. */
    fun forget() {
        layout = null
    }

    fun learn(frame: ByteBuffer, vtable: Int, layout: TableLayout) {
        this.vtable = vtable.toLong()
        this.layout = layout
        reach = 0
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
            reach = maxOf(reach, place.toLong() + field.bytesInTable)
            if (field.kind == FieldKind.INLINE) continue
            fields[count] = field
            places[count++] = place
        }
    }
}
