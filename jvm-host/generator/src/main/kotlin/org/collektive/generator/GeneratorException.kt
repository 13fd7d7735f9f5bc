package org.collektive.generator

/** Something the user has to change; the message says what and where. */
internal class GeneratorException(message: String) : Exception(message)
