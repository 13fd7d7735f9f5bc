package org.collektive.frames

/** A frame, or the user data in one, is malformed; [message] names the field. Nothing of the frame was used. */
public class MalformedFrameException(message: String) : RuntimeException(message)
