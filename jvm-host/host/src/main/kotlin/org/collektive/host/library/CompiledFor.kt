package org.collektive.host.library

import org.collektive.host.programs.ProgramJar
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import java.io.ByteArrayInputStream
import java.util.jar.Attributes
import java.util.jar.JarFile
import java.util.jar.Manifest

/**
 * Refuses jars that were compiled for another library than the session's.
 *
 * The package's tools write into a jar what they compiled it for: `Collektive-Runtime: builtIn`, or `collektive` and the hash of the jars.
 * Of jars that other tools made, each class that they link to must be there.
 */
internal class CompiledFor(private val library: AggregateLibrary) {
    private val runtime = library.runtime

    /** @throws HostException when one of [jars] does not fit. */
    fun check(jars: List<ProgramJar>) {
        for (jar in jars) checkMark(jar)
        val own = jars.flatMapTo(HashSet()) { it.entries.keys }
        for (jar in jars) checkLinks(jar, own)
    }

    private fun checkMark(jar: ProgramJar) {
        val mark = markOf(jar)?.split(' ') ?: return
        if (mark.first() != runtime.key) {
            val other = AggregateRuntime.entries.find { it.key == mark.first() }?.title ?: "runtime '${mark.first()}'"
            throw refused("the jar ${jar.path} was compiled for the $other, and this session runs on the ${runtime.title}")
        }
        if (mark.last() != runtime.key && mark.last() != library.hash) {
            throw refused("the jar ${jar.path} was compiled with other jars than those of the $library")
        }
    }

    private fun checkLinks(jar: ProgramJar, own: Set<String>) {
        val known = HashSet<String>()
        for ((entry, bytes) in jar.entries) {
            if (!entry.endsWith(".class")) continue
            for (name in ClassLinks.of(bytes)) {
                if (PREFIXES.none(name::startsWith) || !known.add(name) || "$name.class" in own || library.has(name)) continue
                val isOurs = name.startsWith(PLUGIN)
                val reason = if (isOurs) "it was compiled for the built-in runtime" else "one of its jars is missing or of another version"
                throw refused("the jar ${jar.path} links to ${name.replace('/', '.')}, which the $library does not have: $reason")
            }
        }
    }

    private fun markOf(jar: ProgramJar): String? =
        jar.entries[JarFile.MANIFEST_NAME]?.let { Manifest(ByteArrayInputStream(it)).mainAttributes.getValue(MARK) }

    private fun refused(what: String) =
        HostException(HostError.PROGRAM, "$what. Build the programs again for the runtime of the session, or run the session on theirs")

    private companion object {
        val MARK = Attributes.Name("Collektive-Runtime")

        /** What the built-in runtime's compiler plugin makes programs link to. */
        const val PLUGIN = "org/collektive/alignment/"
        val PREFIXES = listOf("it/unibo/collektive/", PLUGIN)
    }
}
