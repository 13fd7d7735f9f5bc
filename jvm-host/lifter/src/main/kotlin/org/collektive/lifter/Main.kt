package org.collektive.lifter

import java.nio.file.Path

/** Writes the objects of lifted operators as Kotlin sources into the folder [arguments]`[0]`. */
public fun main(arguments: Array<String>) {
    val folder = Path.of(arguments.single())
    for (lifted in LiftedObject.all()) lifted.file().writeTo(folder)
}
