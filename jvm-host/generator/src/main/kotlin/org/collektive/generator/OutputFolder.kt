package org.collektive.generator

import java.nio.file.Files
import java.nio.file.Path

/** A folder of generated files. An unchanged file keeps its modification time, so that builds do not redo work. */
internal class OutputFolder(private val root: Path) {
    fun write(path: String, text: String): Unit = write(path, text.encodeToByteArray())

    fun write(path: String, bytes: ByteArray) {
        val file = root.resolve(path)
        val old = if (Files.exists(file)) Files.readAllBytes(file) else null
        if (old.contentEquals(bytes)) return
        if (Files.isSymbolicLink(file)) throw GeneratorException("$file is a symbolic link: remove it, or choose another folder")
        if (path.substringAfterLast('.') in SOURCES && old != null && !isGenerated(old)) {
            throw GeneratorException("$file exists and was not generated: move it, or choose another folder")
        }
        Files.createDirectories(file.parent)
        Files.write(file, bytes)
    }

    fun contains(path: String): Boolean = Files.exists(root.resolve(path))

    /** Adds [line] to a file of sorted lines. Keeps other lines for which [isWanted] holds, because schemas share the file. */
    fun addLine(path: String, line: String, isWanted: (String) -> Boolean) {
        val file = root.resolve(path)
        val old = if (Files.exists(file)) Files.readAllLines(file).map(String::trim) else emptyList()
        val others = old.filter { it.isNotEmpty() && isWanted(it) }
        write(path, (others + line).distinct().sorted().joinToString("") { "$it\n" })
    }

    /** Copies files of [folder]; [edit] maps the path and the text of each to the text to write, or to `null` to skip the file. */
    fun copy(folder: Path, edit: (String, String) -> String?) {
        if (!Files.exists(folder)) return
        val files = Files.walk(folder).use { paths -> paths.filter(Files::isRegularFile).sorted().toList() }
        for (file in files) {
            val path = folder.relativize(file).joinToString("/")
            edit(path, Files.readString(file))?.let { write(path, it) }
        }
    }

    /** Returns whether the first line marks a file as generated, or the file is empty because the disk was full. */
    private fun isGenerated(bytes: ByteArray): Boolean = bytes.toString(Charsets.ISO_8859_1).let {
        it.isEmpty() || it.lineSequence().first().contains("generated", ignoreCase = true)
    }

    private companion object {
        val SOURCES = setOf("cs", "java", "kt")
    }
}
