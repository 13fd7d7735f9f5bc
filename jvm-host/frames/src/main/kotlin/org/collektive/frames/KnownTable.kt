package org.collektive.frames

import java.nio.ByteBuffer

/**
 * What the vtable of a table that passed a check says. The tables of a tick share a few vtables, so that little is left to check of the next
 * one. For flat layouts only, whose check never comes back to here.
 */
internal class KnownTable {
    private var layout: TableLayout? = null
    private var vtable = 0L
    private var fields = arrayOfNulls<FieldLayout>(0)
    private var places = IntArray(0)

    /** Bytes from the start of such a table to the end of its last field. */
    var reach = 0L
        private set

    /** Fields that lead somewhere. */
    var count = 0
        private set

    fun isOf(vtable: Long, layout: TableLayout): Boolean = vtable == this.vtable && layout === this.layout

    fun field(index: Int): FieldLayout = fields[index] ?: error("no field $index of $count")

    /** Where the field [index] stands in such a table. */
    fun place(index: Int): Int = places[index]

    /** Nothing is known of another frame. */
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
