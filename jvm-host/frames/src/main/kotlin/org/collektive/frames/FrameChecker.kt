package org.collektive.frames

import java.nio.ByteBuffer

/**
 * Verifies a table and everything that it references: vtables, fields, vectors and strings lie inside the frame, strings are UTF-8, and
 * required fields are present. Reading a verified table never throws.
 *
 * Offsets must point forward, and the sizes of all objects together must not exceed the frame's, shared strings excluded where the
 * [policy] allows them. The work is therefore bounded by the frame's size. Objects may overlap as long as others leave bytes unused.
 * Not thread-safe; allocates only error messages.
 */
public class FrameChecker(private val policy: FramePolicy) {
    private var frame: ByteBuffer = ByteBuffer.allocate(0)
    private var start = 0L
    private var end = 0L

    /** The frame's size minus the sizes of the objects checked so far. Negative only if objects overlap. */
    private var remainingBytes = 0L

    // A direct-mapped cache of verified vtables.
    private val verifiedVtables = Array(CACHE_SIZE) { VerifiedVtable() }

    // The path from the outermost table to the current field, for messages. The index is -1 unless the field is a vector.
    private val fields = arrayOfNulls<FieldLayout>(MAX_DEPTH)
    private val indices = IntArray(MAX_DEPTH)
    private var depth = 0

    /**
     * Verifies the frame between position and limit of [frame]; its root table has [layout].
     *
     * @return the position of the root table, in bytes from the start of the buffer.
     * @throws MalformedFrameException when it is malformed; the message names the field.
     */
    public fun checkRoot(frame: ByteBuffer, layout: TableLayout): Int {
        begin(frame)
        val root = target(start)
        table(root, layout)
        return root.toInt()
    }

    /** Like [checkRoot], for the table at [position], in bytes from the start of the buffer. */
    public fun check(frame: ByteBuffer, position: Int, layout: TableLayout) {
        begin(frame)
        table(position.toLong(), layout)
    }

    private fun begin(frame: ByteBuffer) {
        this.frame = frame
        for (vtable in verifiedVtables) vtable.invalidate()
        start = frame.position().toLong()
        end = frame.limit().toLong()
        remainingBytes = end - start
        depth = 0
    }

    private fun table(position: Long, layout: TableLayout) {
        consume(position, OFFSET_BYTES.toLong())
        if (depth == MAX_DEPTH) fail("is nested deeper than $MAX_DEPTH tables")
        val vtable = position - frame.getInt(position.toInt())
        val known = verifiedVtables[(vtable.toInt() ushr 1) and (CACHE_SIZE - 1)]
        if (known.matches(vtable, layout) && position + known.extent <= end) {
            references(position, known)
        } else {
            wholeTable(position, vtable, layout)
            if (layout.isFlat) known.store(frame, vtable.toInt(), layout)
        }
    }

    /** Checks the strings and vectors of a table whose vtable is verified. */
    private fun references(position: Long, known: VerifiedVtable) {
        if (known.count == 0) return
        depth++
        for (i in 0 until known.count) {
            fields[depth - 1] = known.field(i)
            indices[depth - 1] = -1
            field(known.field(i), position + known.place(i))
        }
        depth--
    }

    private fun wholeTable(position: Long, vtable: Long, layout: TableLayout) {
        inside(vtable, VTABLE_HEADER_BYTES)
        val vtableBytes = frame.getShort(vtable.toInt()).toInt()
        if (vtableBytes < VTABLE_HEADER_BYTES || vtableBytes % 2 != 0) fail("has a damaged vtable")
        inside(vtable, vtableBytes.toLong())
        val tableBytes = if (policy.checksTableSize) {
            frame.getShort(
                (vtable + TABLE_SIZE_ENTRY).toInt(),
            ).toInt() and USHORT
        } else {
            Int.MAX_VALUE
        }
        if (policy.checksTableSize) inside(position, tableBytes.toLong())
        depth++
        val list = layout.fields
        for (i in list.indices) {
            val field = list[i]
            fields[depth - 1] = field
            indices[depth - 1] = -1
            val place = if (field.entry < vtableBytes) frame.getShort((vtable + field.entry).toInt()).toInt() else 0
            when {
                place != 0 -> {
                    if (place < OFFSET_BYTES || place + field.bytesInTable > tableBytes) fail("has a damaged vtable")
                    field(field, position + place)
                }

                field.required -> fail("is required but missing")
            }
        }
        depth--
    }

    private fun field(field: FieldLayout, place: Long) {
        when (field.kind) {
            FieldKind.INLINE -> inside(place, field.bytes.toLong())
            FieldKind.STRING -> string(target(place))
            FieldKind.TABLE -> field.layout?.let { table(target(place), it) }
            FieldKind.VECTOR -> vector(target(place), field.bytes)
            FieldKind.STRINGS, FieldKind.TABLES -> offsets(field, target(place))
        }
    }

    private fun offsets(field: FieldLayout, vector: Long) {
        val count = vector(vector, OFFSET_BYTES)
        for (i in 0 until count) {
            indices[depth - 1] = i
            val target = target(vector + OFFSET_BYTES + i.toLong() * OFFSET_BYTES)
            if (field.layout == null) string(target) else table(target, field.layout)
        }
    }

    /** Returns the position to which the offset at [place] points. */
    private fun target(place: Long): Long {
        inside(place, OFFSET_BYTES.toLong())
        val offset = frame.getInt(place.toInt())
        if (offset <= 0) fail("has a damaged offset")
        return place + offset
    }

    /** Checks a vector without its elements. Returns the number of elements. */
    private fun vector(position: Long, elementBytes: Int): Int {
        val count = count(position)
        consume(position, OFFSET_BYTES + count.toLong() * elementBytes)
        return count
    }

    private fun count(position: Long): Int {
        inside(position, OFFSET_BYTES.toLong())
        val count = frame.getInt(position.toInt())
        if (count < 0) fail("has a damaged length")
        return count
    }

    private fun string(position: Long) {
        val bytes = count(position)
        if (policy.sharesStrings) inside(position, OFFSET_BYTES + bytes.toLong()) else consume(position, OFFSET_BYTES + bytes.toLong())
        if (bytes > policy.maxStringBytes) fail("is a string of $bytes bytes, more than ${policy.maxStringBytes}")
        if (!isUtf8((position + OFFSET_BYTES).toInt(), bytes)) fail("is not UTF-8")
    }

    private fun isUtf8(position: Int, bytes: Int): Boolean {
        val limit = position + bytes
        var at = position
        while (at < limit) {
            val first = frame.get(at).toInt() and 0xFF
            val more = when (first) {
                in 0x00..0x7F -> 0
                in 0xC2..0xDF -> 1
                in 0xE0..0xEF -> 2
                in 0xF0..0xF4 -> 3
                else -> return false
            }
            if (at + more >= limit) return false
            for (k in 1..more) {
                if (frame.get(at + k).toInt() and 0xC0 != 0x80) return false
            }
            if (more >= 2 && !isShortestForm(first, frame.get(at + 1).toInt() and 0xFF)) return false
            at += more + 1
        }
        return true
    }

    /** Rejects overlong forms, surrogates and code points beyond U+10FFFF. */
    private fun isShortestForm(first: Int, second: Int): Boolean = when (first) {
        0xE0 -> second >= 0xA0
        0xED -> second < 0xA0
        0xF0 -> second >= 0x90
        0xF4 -> second < 0x90
        else -> true
    }

    private fun consume(position: Long, bytes: Long) {
        inside(position, bytes)
        remainingBytes -= bytes
        if (remainingBytes < 0) fail("overlaps other data")
    }

    private fun inside(position: Long, bytes: Long) {
        if (position < start || position + bytes > end) fail("lies outside the frame")
    }

    private fun fail(what: String): Nothing {
        val path = (0 until depth).joinToString(".") { i ->
            fields[i]?.name.orEmpty() + if (indices[i] < 0) "" else "[${indices[i]}]"
        }
        throw MalformedFrameException("${path.ifEmpty { "the table" }} $what")
    }

    private companion object {
        const val MAX_DEPTH = 64

        /** Must be a power of two. */
        const val CACHE_SIZE = 8
        const val VTABLE_HEADER_BYTES = 4L
        const val TABLE_SIZE_ENTRY = 2
        const val USHORT = 0xFFFF
    }
}
