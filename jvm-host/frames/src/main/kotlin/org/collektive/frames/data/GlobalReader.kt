package org.collektive.frames.data

import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.TableLayout
import java.nio.ByteBuffer

/** Reads the table `GlobalData` of a frame in place. Created by generated code. Not thread-safe. */
public class GlobalReader(private val layout: TableLayout, private val view: View) {
    private val checker = FrameChecker(FramePolicy.USER_DATA)
    private var frame: ByteBuffer = ByteBuffer.allocate(0)
    private var position = 0

    /** A view of the data, of type `GlobalData`. */
    public val data: Any get() = view.at(position, frame)

    /** Attaches this reader to the table at [position] of [frame]. The frame must not change while [data] is in use. */
    public fun attach(frame: ByteBuffer, position: Int) {
        this.frame = frame
        this.position = position
    }

    /**
     * Verifies that the table lies inside the frame, with its nested tables, vectors and strings.
     *
     * @throws MalformedFrameException when it does not; the message names the field.
     */
    public fun check() {
        checker.check(frame, position, layout)
    }
}
