package org.collektive.frames

/**
 * The rules of [FrameChecker] that differ between frames and the user data inside them.
 *
 * @property sharesStrings whether several offsets may point to the same string.
 * @property maxStringBytes maximum length of a string, in bytes of UTF-8.
 * @property checksTableSize whether the table size in a vtable must cover all fields of its table. Readers do not use that size.
 */
public enum class FramePolicy(
    internal val sharesStrings: Boolean,
    internal val maxStringBytes: Int,
    internal val checksTableSize: Boolean,
) {
    /** Frames of `frame.fbs`. Names of programs and parameters are repeated and short. */
    FRAME(sharesStrings = true, maxStringBytes = 0xFFFF, checksTableSize = true),

    /** The tables `Sensors`, `Actuators` and `GlobalData` of a user's schema. */
    USER_DATA(sharesStrings = false, maxStringBytes = Int.MAX_VALUE, checksTableSize = false),
}
