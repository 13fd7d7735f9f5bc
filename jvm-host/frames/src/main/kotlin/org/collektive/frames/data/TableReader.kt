package org.collektive.frames.data

import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import org.collektive.frames.TableLayout
import java.nio.ByteBuffer

/** Reads the table `GlobalData` of any schema. Generated code makes it. */
public class TableReader(private val layout: TableLayout, private val view: View) : GlobalReader {
    private val checker = FrameChecker(FramePolicy.USER_DATA)
    private var frame: ByteBuffer = ByteBuffer.allocate(0)
    private var position = 0

    override fun attach(frame: ByteBuffer, position: Int) {
        this.frame = frame
        this.position = position
    }

    override fun check() {
        checker.check(frame, position, layout)
    }

    override val data: Any get() = view.at(position, frame)
}
