package org.collektive.frames.data

import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import org.collektive.frames.OFFSET_BYTES
import org.collektive.frames.TableLayout
import java.nio.ByteBuffer

/** Reads the table `Sensors` or `Actuators` of any schema. Generated code makes it. */
public class ElementReader private constructor(private val element: TableLayout?, private val bytes: Int, private val view: View) :
    DataReader {
    private val outline = TableLayout().vector("data", DATA_ENTRY, bytes, false)
    private val whole = if (element == null) outline else TableLayout().tables("data", DATA_ENTRY, element, false)
    private val checker = FrameChecker(FramePolicy.USER_DATA)
    private var frame: ByteBuffer = ByteBuffer.allocate(0)
    private var position = 0
    private var first = 0

    /** For elements that are tables. */
    public constructor(layout: TableLayout, view: View) : this(layout, OFFSET_BYTES, view)

    /** For elements that are structs of [bytes] bytes. */
    public constructor(bytes: Int, view: View) : this(null, bytes, view)

    override var size: Int = 0
        private set

    override fun attach(frame: ByteBuffer, position: Int) {
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

    override fun follow(checked: DataReader) {
        checked as ElementReader
        frame = checked.frame
        position = checked.position
        size = checked.size
        first = checked.first
    }

    override fun check() {
        checker.check(frame, position, whole)
    }

    override fun get(index: Int): Any {
        if (index !in 0 until size) throw IndexOutOfBoundsException("element $index of $size")
        val place = first + index * bytes
        return view.at(if (element == null) place else place + frame.getInt(place), frame)
    }

    private companion object {
        /** Vtable entry of the only field of either table. */
        const val DATA_ENTRY = 4
    }
}
