package org.collektive.generator

import java.nio.file.Files
import java.nio.file.Path

/**
 * Copies of a schema's [files] below the folder [work], from which flatc generates code. The copies contain no character sequences that
 * could end comments in the code. Their relative paths are unchanged, so the binary form contains no absolute paths.
 *
 * @param additions texts to append to the copies of files.
 */
internal class SanitizedSchemas(private val files: List<Path>, core: Path, private val work: Path, additions: Map<Path, String>) {
    private val root = files.map(Path::getParent).reduce { a, b -> generateSequence(a, Path::getParent).first(b::startsWith) }

    /** The folder of the copy of [core], the file of value types. */
    val core: Path = Files.createDirectories(work.resolve("core"))

    init {
        Files.copy(core, this.core.resolve(CORE_TYPES))
        for (file in files) {
            Files.createDirectories(of(file).parent)
            Files.writeString(of(file), SchemaText.read(file).sanitized + additions[file].orEmpty())
        }
    }

    /** The copy of [file]. */
    fun of(file: Path): Path = work.resolve("schema").resolve(root.relativize(file).toString())
}
