package org.collektive.host.fuzz

import org.collektive.host.ProbeJars
import org.collektive.host.TestShim
import org.collektive.host.shim.HostError
import java.nio.file.Files
import java.nio.file.Path
import java.nio.file.StandardCopyOption.REPLACE_EXISTING
import kotlin.io.path.createParentDirectories

/** Calls an entry point of [org.collektive.host.Host] with arbitrary bytes, on one thread. */
internal fun interface Fuzzer {
    /**
     * Runs one input and returns whether it was accepted.
     *
     * @throws IllegalStateException when the host violates its contract.
     */
    fun run(bytes: ByteArray): Boolean
}

/** Checks that a [code] below 0 is one of [allowed]. Any other error, in particular [HostError.JAVA], indicates a bug in the host. */
internal fun requireRefusal(code: Long, allowed: Set<HostError>, shim: TestShim) =
    check(code >= 0 || allowed.any { it.code.toLong() == code }) { "code $code: ${shim.error}" }

/** The jar that requests of the corpus name. Its path is relative to the module's folder, and so the same on all machines. */
internal object FuzzedPrograms {
    const val PATH = "target/fuzzed-programs.jar"

    private val placed by lazy { Files.copy(ProbeJars.harmless, Path.of(PATH).createParentDirectories(), REPLACE_EXISTING) }

    /** Creates the jar if it does not exist. */
    fun place() {
        placed
    }
}
