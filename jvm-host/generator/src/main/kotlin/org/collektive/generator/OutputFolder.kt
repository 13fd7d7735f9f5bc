package org.collektive.generator

import java.nio.file.AccessDeniedException
import java.nio.file.FileAlreadyExistsException
import java.nio.file.FileSystemException
import java.nio.file.Files
import java.nio.file.LinkOption.NOFOLLOW_LINKS
import java.nio.file.Path
import kotlin.io.path.extension
import kotlin.io.path.nameWithoutExtension

/**
 * A folder of generated files. All files are checked when they are added, before [write] writes the first one. An unchanged file
 * keeps its modification time, so that builds do not redo work.
 */
internal class OutputFolder(private val root: Path) {
    private val added = LinkedHashMap<String, ByteArray>()
    private val changed = LinkedHashSet<String>()
    private var previous = emptyList<String>()

    fun add(path: String, text: String): Unit = add(path, text.encodeToByteArray())

    fun add(path: String, bytes: ByteArray) {
        added[path] = bytes
        val file = root.resolve(path)
        // Reading a pipe would wait for its writer.
        if (Files.exists(file) && !Files.isRegularFile(file)) {
            throw GeneratorException("cannot write $file: it is ${if (Files.isDirectory(file)) "a folder" else "not a file"}")
        }
        val old = if (Files.exists(file)) Files.readAllBytes(file) else null
        if (old.contentEquals(bytes)) return
        if (Files.isSymbolicLink(file)) throw GeneratorException("$file is a symbolic link: remove it, or choose another folder")
        if (isSource(path) && old != null && !isGenerated(old)) {
            throw GeneratorException("$file exists and was not generated: move it, or choose another folder")
        }
        val folder = generateSequence(file.toAbsolutePath().parent, Path::getParent).first { Files.exists(it, NOFOLLOW_LINKS) }
        if (!Files.isDirectory(folder)) throw GeneratorException("cannot write $file: $folder: it is not a folder")
        if (!Files.isWritable(folder)) throw GeneratorException("cannot write $file: $folder: permission denied")
        if (Files.isDirectory(root) && !folder.toRealPath().startsWith(root.toRealPath())) {
            throw GeneratorException("cannot write $file: $folder is behind a symbolic link; remove it, or choose another folder")
        }
        changed += path
    }

    /** Writes all added files, and deletes generated files of the schema's previous list that no schema in the folder lists any more. */
    fun write() {
        changed.forEach(::write)
        val obsolete = previous - added.keys
        if (obsolete.isEmpty()) return
        for (file in (obsolete - schemasIn(root).flatMap(::listedIn).toSet()).filter(::isSource).map(root::resolve)) {
            // On systems that ignore case, a renamed type may have the same file.
            if (isOwn(file) && added.keys.none { Files.isSameFile(root.resolve(it), file) }) Files.delete(file)
        }
    }

    private fun write(path: String) {
        val file = root.resolve(path)
        try {
            Files.createDirectories(file.parent)
            // Writing to a hard link would also change its other names.
            Files.deleteIfExists(file)
            Files.write(file, added.getValue(path))
        } catch (e: FileSystemException) {
            val reason = when (e) {
                is FileAlreadyExistsException -> "it is not a folder"
                is AccessDeniedException -> "permission denied"
                else -> e.reason
            }
            throw GeneratorException("cannot write $file: ${e.file}: $reason")
        }
    }

    /** Throws if another schema in this folder has the namespace of the schema whose class is [path]. Both would have the same types. */
    fun checkNamespace(path: String) {
        val own = root.resolve(path)
        if (!Files.isDirectory(own.parent)) return
        // On systems that ignore case, a renamed schema may have the same class.
        val other = schemasIn(own.parent, depth = 1).find {
            it.extension == own.extension && listedIn(it).isNotEmpty() && !(Files.exists(own) && Files.isSameFile(it, own))
        } ?: return
        throw GeneratorException(
            "${other.parent}: its namespace already belongs to the schema of ${other.fileName}: choose another namespace or folder, " +
                "or delete ${other.fileName} if its schema was renamed",
        )
    }

    /** Adds the last source file of a schema. Its last line lists all source files of the schema. */
    fun addSchema(path: String, text: String) {
        previous = listedIn(root.resolve(path))
        add(path, "$text$LIST${(added.keys + path).filter(::isSource).joinToString()}\n")
    }

    /** Returns whether a file is generated and in this folder, not behind a link. */
    private fun isOwn(file: Path): Boolean = Files.isRegularFile(file, NOFOLLOW_LINKS) && file.toRealPath().startsWith(root.toRealPath()) &&
        isGenerated(Files.readAllBytes(file))

    private fun schemasIn(folder: Path, depth: Int = Int.MAX_VALUE): List<Path> =
        Files.walk(folder, depth).use { paths -> paths.filter { it.nameWithoutExtension.endsWith("Schema") }.toList() }

    private fun listedIn(file: Path): List<String> {
        val line = if (Files.isRegularFile(file)) Files.readAllBytes(file).decodeToString().trimEnd().substringAfterLast('\n') else ""
        return if (line.startsWith(LIST)) line.removePrefix(LIST).split(", ") else emptyList()
    }

    private fun isSource(path: String): Boolean = path.substringAfterLast('.') in SOURCES

    fun contains(path: String): Boolean = path in added || Files.exists(root.resolve(path))

    /** Adds [line] to a file of sorted lines. Keeps other lines for which [isWanted] holds, because schemas share the file. */
    fun addLine(path: String, line: String, isWanted: (String) -> Boolean) {
        val file = root.resolve(path)
        val old = if (Files.isRegularFile(file)) Files.readAllLines(file).map(String::trim) else emptyList()
        val others = old.filter { it.isNotEmpty() && isWanted(it) }
        add(path, (others + line).distinct().sorted().joinToString("") { "$it\n" })
    }

    /** Copies files of [folder]; [edit] maps the path and the text of each to the text to add, or to `null` to skip the file. */
    fun copy(folder: Path, edit: (String, String) -> String?) {
        if (!Files.exists(folder)) return
        val files = Files.walk(folder).use { paths -> paths.filter(Files::isRegularFile).sorted().toList() }
        for (file in files) {
            val path = folder.relativize(file).joinToString("/")
            edit(path, Files.readString(file))?.let { add(path, it) }
        }
    }

    /** Returns whether a file begins with the mark of generated files, or the file is empty because the disk was full. */
    private fun isGenerated(bytes: ByteArray): Boolean = bytes.toString(Charsets.ISO_8859_1).let {
        it.isEmpty() || MARKS.any(it::startsWith)
    }

    private companion object {
        const val LIST = "// Files: "
        val MARKS = listOf("// <auto-generated>", "// automatically generated ", "// Generated ")
        val SOURCES = setOf("cs", "java", "kt")
    }
}
