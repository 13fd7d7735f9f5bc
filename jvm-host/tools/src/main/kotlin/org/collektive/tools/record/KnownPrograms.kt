package org.collektive.tools.record

import org.collektive.host.programs.JarBytes
import java.nio.file.Files
import java.nio.file.Path

/** The jars that the user has already run: each of the [folders] contains one file per jar, named by its SHA-256. */
internal class KnownPrograms(private val folders: List<Path>) {
    /**
     * Checks that the user has run all of [jars], which are in the record [file].
     *
     * @throws InvalidRecordException when a jar is unknown.
     */
    fun require(jars: List<JarBytes>, file: String) {
        val unknown = jars.map(::sha256).find { hash -> folders.none { Files.exists(it.resolve(hash)) } } ?: return
        throw InvalidRecordException(
            "$file contains programs that have never run here (SHA-256 $unknown), and a replay runs their code with your permissions: " +
                "add --trust if you trust the author of the record, or replay other programs with --programs JAR",
        )
    }
}
