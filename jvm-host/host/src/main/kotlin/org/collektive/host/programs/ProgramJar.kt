package org.collektive.host.programs

import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import java.io.ByteArrayInputStream
import java.io.IOException
import java.util.zip.ZipInputStream

/**
 * A jar of the user's, unpacked in memory: its file can be replaced while its programs run.
 *
 * @property path where it came from.
 * @property entries contents by name.
 */
public class ProgramJar private constructor(public val path: String, internal val entries: Map<String, ByteArray>) {
    public companion object {
        private const val END_RECORD_BYTES = 22
        private const val END_RECORD = 0x06054b50

        /**
         * Unpacks [jar].
         *
         * @throws HostException when it is damaged.
         */
        public fun open(jar: JarBytes): ProgramJar {
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
