package org.collektive.host.programs

import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import java.io.ByteArrayInputStream
import java.io.IOException
import java.util.zip.ZipInputStream

/**
 * A jar that is unpacked in memory, so that its file can be replaced while its classes are in use.
 *
 * @property path the path from which it was read.
 * @property entries contents of the entries by name.
 */
public class ProgramJar private constructor(public val path: String, internal val entries: Map<String, ByteArray>) {
    public companion object {
        /** A small file can unpack to any size. */
        private const val MAX_BYTES = 256 shl 20
        private const val BUFFER_BYTES = 1 shl 16
        private const val END_RECORD_BYTES = 22
        private const val END_RECORD = 0x06054b50

        /**
         * Unpacks [jar].
         *
         * @throws HostException when the jar is damaged, or contains more than 256 MiB.
         */
        public fun open(jar: JarBytes): ProgramJar {
            if (!hasEndRecord(jar.bytes)) throw jar.damaged("the end of the file is missing")
            return try {
                requireSize(jar)
                ProgramJar(jar.path, unzip(jar))
            } catch (e: IOException) {
                throw jar.damaged(e.message)
            } catch (e: IllegalArgumentException) {
                throw jar.damaged(e.message)
            }
        }

        /** Rejects a jar whose content is too large, before any of it is unpacked. */
        private fun requireSize(jar: JarBytes) {
            var left = MAX_BYTES
            val buffer = ByteArray(BUFFER_BYTES)
            ZipInputStream(ByteArrayInputStream(jar.bytes)).use { zip ->
                while (zip.nextEntry != null) {
                    while (true) {
                        val count = zip.read(buffer)
                        if (count < 0) break
                        left -= count
                        if (left >= 0) continue
                        throw HostException(
                            HostError.PROGRAM,
                            "the jar ${jar.path} contains more than 256 MiB: divide it into several jars",
                        )
                    }
                }
            }
        }

        private fun unzip(jar: JarBytes): Map<String, ByteArray> {
            val entries = LinkedHashMap<String, ByteArray>()
            ZipInputStream(ByteArrayInputStream(jar.bytes)).use { zip ->
                while (true) {
                    val entry = zip.nextEntry ?: break
                    if (!entry.isDirectory) entries[entry.name] = zip.readAllBytes()
                }
            }
            return entries
        }

        /** Returns whether the file is complete: ZIP files end with a record that [ZipInputStream] does not check. */
        private fun hasEndRecord(bytes: ByteArray): Boolean {
            val last = bytes.size - END_RECORD_BYTES
            return (last downTo maxOf(0, last - 0xFFFF)).any { at ->
                (0 until Int.SIZE_BYTES).all { bytes[at + it] == (END_RECORD ushr 8 * it).toByte() }
            }
        }
    }
}
