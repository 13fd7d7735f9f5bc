package org.collektive.lifter

import java.nio.file.Path
import kotlin.io.path.createParentDirectories
import kotlin.io.path.writeText

/** Writes the objects of lifted operators as Kotlin sources into the folder [arguments]`[0]`. */
public fun main(arguments: Array<String>) {
    val folder = Path.of(arguments.single())
    for (lifted in LiftedObject.all()) folder.resolve(lifted.path).createParentDirectories().writeText(lifted.source())
}
