package org.collektive.generator

/** The user must change something; the message says what and where. */
internal class GeneratorException(message: String) : Exception(message)
