package org.collektive.frames.data

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.TableLayout
import java.nio.ByteBuffer
import java.nio.ByteOrder
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

/** Tests that each of several tables is checked, although they share a vtable. */
internal class ElementReaderTest {
    private val layout = TableLayout().inline("number", 4, 8, false).string("name", 6, false)
    private val frame = frame(3)

    @Test
    fun `tables that share a vtable pass`() = assertEquals(3, checked().size)

    @Test
    fun `a string outside the frame is rejected`() {
        frame.putInt(field(2, NAME), 1 shl 20)
        assertEquals("data[2].name lies outside the frame", assertFailsWith<MalformedFrameException> { checked() }.message)
    }

    @Test
    fun `a damaged offset of a string is rejected`() {
        frame.putInt(field(2, NAME), 0)
        assertEquals("data[2].name has a damaged offset", assertFailsWith<MalformedFrameException> { checked() }.message)
    }

    @Test
    fun `a damaged vtable is rejected`() {
        frame.putInt(table(2), 1 shl 20)
        assertEquals("data[2] lies outside the frame", assertFailsWith<MalformedFrameException> { checked() }.message)
    }

    @Test
    fun `a number beyond the end of the frame is rejected`() {
        // The frame ends after the table's first four bytes, although the vtable declares a field behind them.
        val end = frame.limit() - Int.SIZE_BYTES
        val vtable = table(1) - frame.getInt(table(1))
        frame.putInt(end, end - vtable)
        frame.putInt(element(2), end - element(2))
        assertEquals("data[2].number lies outside the frame", assertFailsWith<MalformedFrameException> { checked() }.message)
    }

    @Test
    fun `the next frame is checked from the beginning`() {
        val reader = ElementReader(layout)
        reader.attach(frame, frame.getInt(0))
        reader.check()
        // The tables are at the same positions, but the vtable is damaged.
        frame.putShort(table(0) - frame.getInt(table(0)), 3)
        assertFailsWith<MalformedFrameException> { reader.check() }
    }

    private fun checked() = ElementReader(layout).also {
        it.attach(frame, frame.getInt(0))
        it.check()
    }

    private fun element(index: Int): Int {
        val sensors = frame.getInt(0)
        val field = sensors + frame.getShort(sensors - frame.getInt(sensors) + 4)
        return field + frame.getInt(field) + Int.SIZE_BYTES * (1 + index)
    }

    private fun table(index: Int) = element(index) + frame.getInt(element(index))

    private fun field(index: Int, entry: Int) = table(index) + frame.getShort(table(index) - frame.getInt(table(index)) + entry)

    private fun frame(count: Int): ByteBuffer {
        val builder = FlatBufferBuilder()
        val tables = IntArray(count) { index ->
            val name = builder.createString("node $index")
            builder.startTable(2)
            builder.addLong(0, 1L + index, 0)
            builder.addOffset(1, name, 0)
            builder.endTable()
        }
        val data = builder.createVectorOfTables(tables)
        builder.startTable(1)
        builder.addOffset(0, data, 0)
        builder.finish(builder.endTable())
        return ByteBuffer.wrap(builder.sizedByteArray()).order(ByteOrder.LITTLE_ENDIAN)
    }

    private companion object {
        const val NAME = 6
    }
}
