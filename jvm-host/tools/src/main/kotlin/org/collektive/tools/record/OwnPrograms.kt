package org.collektive.tools.record

import java.nio.file.Files
import java.nio.file.Path

/** The jars that the user has run: each of the [folders] has a file for each, named by its SHA-256. */
internal class OwnPrograms(private val folders: List<Path>) {
    /**
     * Checks that all jars of the [record] in [file] are among them.
     *
     * @throws RecordRefused when one is not.
     */
    fun require(record: Record, file: String) {
        val stranger = record.jars.map(::sha256).find { hash -> folders.none { Files.exists(it.resolve(hash)) } } ?: return
        throw RecordRefused(
            "$file contains programs that were never run here (SHA-256 $stranger), and a replay runs their code with your rights: " +
                "add --trust if you trust whoever made the record, or name programs of yours with --programs JAR",
        )
    }
}
