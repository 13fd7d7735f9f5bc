package org.collektive.generator

/** An error in the user's schema or arguments. The message contains the place and the solution. */
internal class GeneratorException(message: String) : Exception(message)
