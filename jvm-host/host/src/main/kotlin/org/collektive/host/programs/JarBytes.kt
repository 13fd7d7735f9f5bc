package org.collektive.host.programs

import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import java.io.ByteArrayInputStream
import java.io.IOException
import java.nio.file.Files
import java.nio.file.InvalidPathException
import java.nio.file.NoSuchFileException
import java.nio.file.Path
import java.util.zip.ZipInputStream

/** The bytes of a jar, and the path from which they were read. */
public class JarBytes(public val path: String, public val bytes: ByteArray) {
    /**
     * Returns the content of the entry [name], or `null` if it does not exist.
     *
     * @throws HostException when the jar is damaged, or the entry is larger than 16 MiB.
     */
    public fun entry(name: String): ByteArray? = try {
        ZipInputStream(ByteArrayInputStream(bytes)).use { zip ->
            generateSequence(zip::getNextEntry).find { it.name == name }?.let { zip.readNBytes(MAX_ENTRY_BYTES + 1) }
        }
    } catch (e: IOException) {
        throw damaged(e.message)
    } catch (e: IllegalArgumentException) {
        throw damaged(e.message)
    }.also { if (it != null && it.size > MAX_ENTRY_BYTES) throw damaged("$name is larger than $MAX_ENTRY_BYTES bytes") }

    internal fun damaged(why: String?) = HostException(HostError.PROGRAM, "the jar $path is damaged ($why); rebuild it")

    public companion object {
        private const val MAX_ENTRY_BYTES = 16 shl 20

        /**
         * Reads the jar at [path].
         *
         * @throws HostException when it cannot be read.
         */
        public fun read(path: String): JarBytes = try {
            JarBytes(path, Files.readAllBytes(Path.of(path)))
        } catch (e: NoSuchFileException) {
            throw HostException(HostError.PROGRAM, "jar $path does not exist; build the programs, or correct the path", e)
        } catch (e: InvalidPathException) {
            throw HostException(HostError.PROGRAM, "'$path' is not a valid path of a jar; correct it", e)
        } catch (e: IOException) {
            throw HostException(
                HostError.PROGRAM,
                "the jar $path cannot be read: $e; check its permissions, and close other programs that use it",
                e,
            )
        }
    }
}
