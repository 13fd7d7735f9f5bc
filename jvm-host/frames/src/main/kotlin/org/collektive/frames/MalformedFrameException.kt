package org.collektive.frames

/**
 * A frame, or the user data in one, is malformed; [message] names the field. Nothing of the frame was used.
 *
 * @property tick the tick of the frame if only its user data is malformed; otherwise `null`.
 */
public class MalformedFrameException(message: String, public val tick: Long? = null) : RuntimeException(message)
