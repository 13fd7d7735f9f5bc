package org.collektive.host.programs

import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import java.io.IOException
import java.nio.file.Files
import java.nio.file.InvalidPathException
import java.nio.file.NoSuchFileException
import java.nio.file.Path

/** The bytes of a jar, and the path from which they were read. */
public class JarBytes(public val path: String, public val bytes: ByteArray) {
    public companion object {
        /**
         * Reads the jar at [path].
         *
         * @throws HostException when it cannot be read.
         */
        public fun read(path: String): JarBytes = try {
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
