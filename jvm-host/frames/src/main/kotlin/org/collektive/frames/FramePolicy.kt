package org.collektive.frames

/**
 * Rules of [FrameChecker] in which frames and the user data in them differ.
 *
 * @property sharesStrings whether several offsets may lead to one string; else no byte belongs to two objects.
 * @property maxStringBytes longest string, in bytes of UTF-8.
 * @property checksTableSize whether the table size in a vtable must hold all fields of its table. Reading does not depend on it.
 */
public enum class FramePolicy(internal val sharesStrings: Boolean, internal val maxStringBytes: Int, internal val checksTableSize: Boolean) {
    /** Frames of `frame.fbs`: names of programs and parameters repeat, and are short. */
    FRAME(sharesStrings = true, maxStringBytes = 0xFFFF, checksTableSize = true),

    /** The tables `Sensors`, `Actuators` and `GlobalData` of a user's schema. */
    USER_DATA(sharesStrings = false, maxStringBytes = Int.MAX_VALUE, checksTableSize = false),
}
