package org.collektive.frames.data

import java.nio.ByteBuffer

/** Points flatc's reader of one user type at a place of a frame; `__assign` of generated code. */
public fun interface View {
    /** The reader, the same object at every call. */
    public fun at(position: Int, frame: ByteBuffer): Any
}
