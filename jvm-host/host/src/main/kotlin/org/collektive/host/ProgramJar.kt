package org.collektive.host

import java.io.ByteArrayInputStream
import java.io.IOException
import java.nio.file.Files
import java.nio.file.InvalidPathException
import java.nio.file.NoSuchFileException
import java.nio.file.Path
import java.util.zip.ZipInputStream

/** The bytes of a jar, and the path that they come from. */
internal class JarBytes(val path: String, val bytes: ByteArray) {
    companion object {
        /** Reads the jar at [path]. */
        fun read(path: String): JarBytes = try {
            JarBytes(path, Files.readAllBytes(Path.of(path)))
        } catch (e: NoSuchFileException) {
            throw HostException(HostError.PROGRAM, "there is no jar $path; build the programs, or correct the path", e)
        } catch (e: InvalidPathException) {
            throw HostException(HostError.PROGRAM, "'$path' is not a path of a jar", e)
        } catch (e: IOException) {
            throw HostException(HostError.PROGRAM, "the jar $path cannot be read: $e", e)
        }
    }
}

/** A jar of the user's, read into memory: the file can be replaced while its programs run. */
internal class ProgramJar private constructor(val path: String, val entries: Map<String, ByteArray>) {
    companion object {
        private const val END_RECORD_BYTES = 22
        private const val END_RECORD = 0x06054b50

        /** Opens [jar]. */
        fun open(jar: JarBytes): ProgramJar {
            val path = jar.path
            if (!hasEndRecord(jar.bytes)) throw damaged(path, "its end is missing")
            return try {
                ProgramJar(path, unzip(jar.bytes))
            } catch (e: IOException) {
                throw damaged(path, e.message)
            } catch (e: IllegalArgumentException) {
                throw damaged(path, e.message)
            }
        }

        private fun damaged(path: String, why: String?) =
            HostException(HostError.PROGRAM, "the jar $path is damaged ($why); build it again")

        private fun unzip(bytes: ByteArray): Map<String, ByteArray> {
            val entries = LinkedHashMap<String, ByteArray>()
            ZipInputStream(ByteArrayInputStream(bytes)).use { zip ->
                while (true) {
                    val entry = zip.nextEntry ?: break
                    if (!entry.isDirectory) entries[entry.name] = zip.readAllBytes()
                }
            }
            return entries
        }

        /** A ZIP file ends with a record that a truncated one lacks; streams do not look at it. */
        private fun hasEndRecord(bytes: ByteArray): Boolean {
            val last = bytes.size - END_RECORD_BYTES
            return (last downTo maxOf(0, last - 0xFFFF)).any { at ->
                (0 until Int.SIZE_BYTES).all { bytes[at + it] == (END_RECORD ushr 8 * it).toByte() }
            }
        }
    }
}
