package org.collektive.generator

import java.nio.file.Files
import java.nio.file.Path

/**
 * Copies of a schema's [files] below the folder [work], from which flatc makes code: without what could end a comment in it. They lie as the
 * originals do relative to each other, so that their binary form does not name places of this machine.
 */
internal class HarmlessCopies(private val files: List<Path>, core: Path, private val work: Path) {
    private val root = files.map(Path::getParent).reduce { a, b -> generateSequence(a, Path::getParent).first(b::startsWith) }

    /** The folder of the copy of [core], the file of value types. */
    val core: Path = Files.createDirectories(work.resolve("core"))

    init {
        Files.copy(core, this.core.resolve(CORE_TYPES))
        for (file in files) {
            Files.createDirectories(of(file).parent)
            Files.writeString(of(file), SchemaText.read(file).harmless)
        }
    }

    /** The copy of [file]. */
    fun of(file: Path): Path = work.resolve("schema").resolve(root.relativize(file).toString())
}
