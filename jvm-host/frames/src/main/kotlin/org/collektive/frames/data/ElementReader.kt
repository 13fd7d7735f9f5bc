package org.collektive.frames.data

import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.OFFSET_BYTES
import org.collektive.frames.TableLayout
import java.nio.ByteBuffer

/**
 * Finds and verifies the elements of the table `Sensors` or `Actuators` of a frame, in place. Created by generated code. Allocates only in
 * its constructor. Not thread-safe, but threads may call [place] concurrently.
 */
public class ElementReader private constructor(private val element: TableLayout?, private val bytes: Int) {
    private val outline = TableLayout().vector("data", DATA_ENTRY, bytes, false)
    private val whole = if (element == null) outline else TableLayout().tables("data", DATA_ENTRY, element, false)
    private val checker = FrameChecker(FramePolicy.USER_DATA)
    private var position = 0
    private var first = 0

    /** Creates a reader of elements that are tables. */
    public constructor(layout: TableLayout) : this(layout, OFFSET_BYTES)

    /** Creates a reader of elements that are structs of [bytes] bytes. */
    public constructor(bytes: Int) : this(null, bytes)

    /** The attached frame. */
    public var frame: ByteBuffer = ByteBuffer.allocate(0)
        private set

    /** Number of elements in the attached table. */
    public var size: Int = 0
        private set

    /**
     * Attaches this reader to the table at [position] of [frame], in bytes from the start of the buffer. The frame extends from the
     * buffer's position to its limit; the buffer must be little-endian.
     *
     * @throws MalformedFrameException when the table or its vector lies outside the frame.
     */
    public fun attach(frame: ByteBuffer, position: Int) {
        checker.check(frame, position, outline)
        this.frame = frame
        this.position = position
        val vtable = position - frame.getInt(position)
        val field = if (frame.getShort(vtable) > DATA_ENTRY) frame.getShort(vtable + DATA_ENTRY).toInt() else 0
        if (field == 0) {
            size = 0
        } else {
            val vector = position + field + frame.getInt(position + field)
            size = frame.getInt(vector)
            first = vector + OFFSET_BYTES
        }
    }

    /**
     * Verifies that every element lies inside the frame, with its nested tables, vectors and strings. Reading verified elements never
     * throws.
     *
     * @throws MalformedFrameException when an element does not; the message names the element and the field.
     */
    public fun check() {
        checker.check(frame, position, whole)
    }

    /** Returns the position of element [index] in [frame], in bytes. */
    public fun place(index: Int): Int {
        if (index !in 0 until size) throw IndexOutOfBoundsException("element $index of $size")
        val place = first + index * bytes
        return if (element == null) place else place + frame.getInt(place)
    }

    private companion object {
        /** Vtable entry of the only field of either table. */
        const val DATA_ENTRY = 4
    }
}
