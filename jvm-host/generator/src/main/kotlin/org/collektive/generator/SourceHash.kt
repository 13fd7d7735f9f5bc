package org.collektive.generator

import java.nio.file.FileVisitOption
import java.nio.file.Files
import java.nio.file.Path
import java.security.MessageDigest
import java.util.HexFormat
import kotlin.io.path.isDirectory
import kotlin.io.path.isRegularFile
import kotlin.io.path.name
import kotlin.io.path.readBytes

/**
 * The hash of a jar's sources, stored in the jar's manifest. The editor uses it to detect outdated jars. `SourceHash.cs` computes the same
 * hash without a JVM.
 *
 * The hash covers the names and contents of the schema, of the files that it includes (except files of the package), and of the Kotlin
 * files. Paths are relative to the schema's or the programs' folder, and each group is sorted by path. Carriage returns are ignored,
 * because Git adds them to files on Windows.
 */
internal object SourceHash {
    /** Also matches in comments, which only adds files to the hash. */
    private val INCLUDE = Regex("""\binclude(?>\s+|//[^\r\n]*|/\*[\s\S]*?\*/)*["']([^"']+)["']""")

    fun of(schema: Path, sources: List<Path>): String {
        val digest = MessageDigest.getInstance("SHA-256")
        val file = schema.toAbsolutePath().normalize()
        val schemas = HashSet<Path>().also { addIncluded(file, file.parent, it) }
        add(digest, schemas.associateBy { name(file.parent, it) })
        val kotlin = sources.flatMap { source ->
            files(source).map { (if (source.isDirectory()) name(source, it) else it.name) to it }
        }
        add(digest, kotlin.toMap())
        return HexFormat.of().formatHex(digest.digest())
    }

    private fun addIncluded(file: Path, root: Path, found: MutableSet<Path>) {
        if (!found.add(file)) return
        // The generator reports files that are not text.
        for (include in INCLUDE.findAll(file.readBytes().decodeToString())) {
            val name = include.groupValues[1]
            listOf(file.parent, root).map { it.resolve(name).normalize() }.find { it.isRegularFile() }?.let { addIncluded(it, root, found) }
        }
    }

    /** Follows symbolic links, as Unity and the Kotlin compiler do. */
    private fun files(source: Path): List<Path> = Files.walk(source, FileVisitOption.FOLLOW_LINKS).use { paths ->
        paths.filter { it.name.endsWith(".kt") && it.isRegularFile() }.toList()
    }

    private fun name(folder: Path, file: Path) = folder.relativize(file).joinToString("/")

    private fun add(digest: MessageDigest, files: Map<String, Path>) {
        for ((name, file) in files.toSortedMap()) {
            digest.update(name.encodeToByteArray())
            digest.update(0)
            digest.update(file.readBytes().filter { it != '\r'.code.toByte() }.toByteArray())
            digest.update(0)
        }
    }
}
