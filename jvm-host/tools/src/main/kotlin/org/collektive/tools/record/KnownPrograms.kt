package org.collektive.tools.record

import java.nio.file.Files
import java.nio.file.Path

/** The jars that the user has already run: each of the [folders] contains one file per jar, named by its SHA-256. */
internal class KnownPrograms(private val folders: List<Path>) {
    /**
     * Checks that the user has run all jars of the [record] in [file].
     *
     * @throws InvalidRecordException when a jar is unknown.
     */
    fun require(record: Record, file: String) {
        val unknown = record.jars.map(::sha256).find { hash -> folders.none { Files.exists(it.resolve(hash)) } } ?: return
        throw InvalidRecordException(
            "$file contains programs that have never run here (SHA-256 $unknown), and a replay runs their code with your permissions: " +
                "add --trust if you trust the author of the record, or replay other programs with --programs JAR",
        )
    }
}
