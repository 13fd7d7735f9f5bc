package org.collektive.generator

/** An error in the user's schema or arguments. The message states the location and the fix. */
internal class GeneratorException(message: String) : Exception(message)
