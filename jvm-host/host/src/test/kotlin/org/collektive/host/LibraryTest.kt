package org.collektive.host

import org.collektive.frame.AggregateRuntime
import org.collektive.host.library.AggregateLibrary
import org.collektive.host.shim.HostError
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import java.util.zip.ZipEntry
import java.util.zip.ZipFile
import java.util.zip.ZipOutputStream
import kotlin.io.path.copyTo
import kotlin.io.path.outputStream
import kotlin.io.path.writeBytes
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/** Tests that programs run only on the library for which they were compiled. Both libraries are on the class path of the tests. */
@Timeout(60)
class LibraryTest {
    private val shim = TestShim()

    @TempDir
    lateinit var folder: Path

    @Test
    fun `programs give the same answers on both runtimes`() {
        val answers = listOf(AggregateRuntime.BuiltIn, AggregateRuntime.Collektive).map { runtime ->
            val session = TestSession(shim)
            check(session.open(runtime = runtime) >= 0) { shim.error }
            val all = (1..5).map { tick -> session.answers(session.ok(step(tick))) }
            session.close()
            all
        }
        assertEquals(answers.first(), answers.last())
        assertEquals(3, answers.first().last().size)
    }

    @Test
    fun `a jar that was compiled for the other runtime is refused`() {
        refused(
            marked("collektive abc"),
            AggregateRuntime.BuiltIn,
            "was compiled for the Collektive runtime",
            "runs on the built-in runtime",
        )
        refused(marked("builtIn"), AggregateRuntime.Collektive, "was compiled for the built-in runtime", "runs on the Collektive runtime")
        refused(marked("other"), AggregateRuntime.BuiltIn, "was compiled for the runtime 'other'")
    }

    @Test
    fun `a jar that was compiled with other jars of the same runtime is refused`() = refused(
        marked("collektive abc"),
        AggregateRuntime.Collektive,
        "was compiled with different jars than those of the Collektive runtime",
    )

    @Test
    fun `a jar that was compiled for the session's runtime is accepted`() {
        val session = TestSession(shim)
        assertTrue(session.open(listOf(marked("builtIn"))) >= 0, shim.error)
        session.close()
    }

    @Test
    fun `a jar that references a class that is missing in the library is refused`() {
        val other = patched("it/unibo/collektive/aggregate/FieldEntry", "it/unibo/collektive/aggregate/FieldOther")
        refused(other, AggregateRuntime.BuiltIn, "references it.unibo.collektive.aggregate.FieldOther", "missing or has the wrong version")
        val plugin = patched("it/unibo/collektive/aggregate/FieldEntry", "org/collektive/alignment/ProgramPlacesOf")
        refused(
            plugin,
            AggregateRuntime.Collektive,
            "references org.collektive.alignment.ProgramPlacesOf",
            "it was compiled for the built-in runtime",
        )
    }

    @Test
    fun `a function that is missing in the library fails the round with the reason`() {
        val session = TestSession(shim)
        check(session.open(listOf(patched("getNeighbors", "getNeighbord"))) >= 0) { shim.error }
        val error = session.errors(session.ok(step(1))).values.first()
        session.close()
        assertContains(error, "NoSuchMethodError")
        assertContains(error, "rebuild the programs against the jars that run them")
    }

    @Test
    fun `a user's library can be replaced while it is in use`() {
        val jar = folder.resolve("library.jar")
        ProbeJars.programs.copyTo(jar)
        val loader = AggregateLibrary.loaderInMemory(listOf(jar))
        assertEquals("SensorData", loader.loadClass("probe.SensorData").simpleName)
        jar.writeBytes(ByteArray(100))
        assertEquals("Programs", loader.loadClass("probe.Programs").simpleName)
        assertNotNull(loader.getResource("probe/Programs.class")).readBytes()
    }

    @Test
    fun `an unknown runtime is refused`() {
        assertEquals(HostError.FRAME.code.toLong(), TestSession(shim).open(runtime = 7))
        assertContains(shim.error, "unknown aggregate runtime 7")
    }

    private fun refused(jar: String, runtime: Int, vararg parts: String) {
        assertEquals(HostError.PROGRAM.code.toLong(), TestSession(shim).open(listOf(jar), runtime = runtime), shim.error)
        for (part in listOf(*parts, jar, "Rebuild the programs")) assertContains(shim.error, part)
    }

    private fun step(number: Int) = Step(number.toLong()).apply {
        if (number == 1) {
            added = List(3) { Step.Added(it) }
            linked = listOf(0 to 1, 1 to 2, 2 to 0)
        }
        due = listOf(0, 1, 2)
        sensors = due.map { Step.Sensor(10 * number + it) }
    }

    /** Returns the probe's jar with a mark in its manifest that names the runtime for which it was compiled. */
    private fun marked(mark: String) = repacked("META-INF/MANIFEST.MF" to "Manifest-Version: 1.0\nCollektive-Runtime: $mark\n\n") { it }

    /** Returns the probe's jar, in whose class files [name] is replaced with [other], which has the same length. */
    private fun patched(name: String, other: String) = repacked { bytes ->
        require(name.length == other.length)
        bytes.toString(Charsets.ISO_8859_1).replace(name, other).toByteArray(Charsets.ISO_8859_1)
    }

    private fun repacked(vararg added: Pair<String, String>, change: (ByteArray) -> ByteArray): String {
        val jar = folder.resolve("repacked.jar")
        ZipFile(ProbeJars.programs.toFile()).use { old ->
            ZipOutputStream(jar.outputStream()).use { zip ->
                for (entry in old.entries().asSequence().filterNot { it.isDirectory }) {
                    zip.putNextEntry(ZipEntry(entry.name))
                    val bytes = old.getInputStream(entry).readBytes()
                    zip.write(if (entry.name.startsWith("probe/Programs")) change(bytes) else bytes)
                }
                for ((name, text) in added) {
                    zip.putNextEntry(ZipEntry(name))
                    zip.write(text.toByteArray())
                }
            }
        }
        return jar.toString()
    }
}
