package org.collektive.frames

/** A frame, or user data in one, that cannot be read; [message] names the field. Nothing of it was used. */
public class MalformedFrameException(message: String) : RuntimeException(message)
