package org.collektive.host.library

import org.collektive.host.programs.ConstantPool
import org.collektive.host.programs.ProgramJar
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import java.io.ByteArrayInputStream
import java.util.jar.Attributes
import java.util.jar.JarFile
import java.util.jar.Manifest

/**
 * Rejects jars that were compiled for another library than the session's.
 *
 * The package's build tools write the target into the manifest of a jar: `Collektive-Runtime: builtIn`, or `collektive` and the hash of the
 * library's jars. For jars of other tools, each class that they reference must exist.
 */
internal class RuntimeCompatibility(private val library: AggregateLibrary) {
    private val runtime = library.runtime

    /**
     * Checks [jars].
     *
     * @throws HostException when a jar does not match the library.
     */
    fun check(jars: List<ProgramJar>) {
        for (jar in jars) checkManifest(jar)
        val own = jars.flatMapTo(HashSet()) { it.entries.keys }
        for (jar in jars) checkReferences(jar, own)
    }

    private fun checkManifest(jar: ProgramJar) {
        val target = targetOf(jar)?.split(' ') ?: return
        if (target.first() != runtime.key) {
            val other = AggregateRuntime.entries.find { it.key == target.first() }?.title ?: "runtime '${target.first()}'"
            throw incompatible("the jar ${jar.path} was compiled for the $other, and this session runs on the ${runtime.title}")
        }
        if (target.last() != runtime.key && target.last() != library.hash) {
            throw incompatible("the jar ${jar.path} was compiled with different jars than those of the $library")
        }
    }

    private fun checkReferences(jar: ProgramJar, own: Set<String>) {
        val known = HashSet<String>()
        for ((entry, bytes) in jar.entries) {
            if (!entry.endsWith(".class")) continue
            for (name in ConstantPool.of(bytes).classes) {
                if (PREFIXES.none(name::startsWith) || !known.add(name) || "$name.class" in own || library.contains(name)) continue
                val isBuiltIn = name.startsWith(ALIGNMENT)
                val other = "one of its jars is missing or has the wrong version"
                val reason = if (isBuiltIn) "it was compiled for the built-in runtime" else other
                val missing = name.replace('/', '.')
                throw incompatible("the jar ${jar.path} references $missing, which is missing in the $library: $reason")
            }
        }
    }

    private fun targetOf(jar: ProgramJar): String? =
        jar.entries[JarFile.MANIFEST_NAME]?.let { Manifest(ByteArrayInputStream(it)).mainAttributes.getValue(ATTRIBUTE) }

    private fun incompatible(what: String) = HostException(
        HostError.PROGRAM,
        "$what. Rebuild the programs for the session's runtime, or run the session on the runtime that they were compiled for",
    )

    private companion object {
        val ATTRIBUTE = Attributes.Name("Collektive-Runtime")

        /** Package of the classes that only programs of the built-in runtime's compiler plugin reference. */
        const val ALIGNMENT = "org/collektive/alignment/"
        val PREFIXES = listOf("it/unibo/collektive/", ALIGNMENT)
    }
}
