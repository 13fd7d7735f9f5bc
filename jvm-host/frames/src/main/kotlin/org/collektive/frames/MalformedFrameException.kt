package org.collektive.frames

/**
 * Thrown when a frame, or the user data in it, is malformed. [message] names the field; no part of the frame has been used.
 *
 * @property tick the tick of the frame if only its user data is malformed; otherwise `null`.
 */
public class MalformedFrameException(message: String, public val tick: Long? = null) : RuntimeException(message)
