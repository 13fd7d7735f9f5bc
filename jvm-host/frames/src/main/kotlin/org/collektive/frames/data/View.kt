package org.collektive.frames.data

import java.nio.ByteBuffer

/** Positions flatc's accessor of one user type; implemented by `__assign` of generated code. */
public fun interface View {
    /** Positions the accessor at [position] of [frame] and returns it. Every call returns the same object, valid until the next call. */
    public fun at(position: Int, frame: ByteBuffer): Any
}
