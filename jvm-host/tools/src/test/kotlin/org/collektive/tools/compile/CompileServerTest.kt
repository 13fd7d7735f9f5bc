package org.collektive.tools.compile

import org.junit.jupiter.api.AfterEach
import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Files
import java.nio.file.Path
import java.util.concurrent.TimeUnit
import java.util.jar.JarFile
import java.util.zip.ZipEntry
import java.util.zip.ZipOutputStream
import kotlin.io.path.createDirectories
import kotlin.io.path.deleteExisting
import kotlin.io.path.exists
import kotlin.io.path.readBytes
import kotlin.io.path.readText
import kotlin.io.path.writeBytes
import kotlin.io.path.writeText
import kotlin.test.assertContains
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/**
 * Tests the process that compiles programs, with the real compilers. Its code is in the module `generator`, whose tests have no Kotlin
 * compiler.
 */
@Tag("slow")
@Timeout(300)
class CompileServerTest {
    @field:TempDir
    lateinit var folder: Path

    private val started = ArrayList<Process>()
    private val jar by lazy { folder.resolve("swarm.clkprograms") }
    private val programs by lazy { folder.resolve("Programs").createDirectories() }
    private val requests by lazy { folder.resolve("requests").createDirectories() }

    @AfterEach
    fun stop() = started.forEach { it.destroyForcibly().waitFor() }

    @Tag("repeats")
    @Test
    fun `a process answers one request after the other, and ends with its client`() {
        val client = start("/bin/sleep", "1000")
        val server = start(*command, "--serve", "$requests", "${client.pid()}")
        write("Hops.kt", "fun hops(sensors: SensorData) = ActuatorData(hops = sensors.intensity())")
        assertEquals(0 to "", ask(words()))
        assertEquals(setOf("swarm/HopsKt.class"), classes("Kt.class"))
        val first = jar.readBytes()
        assertEquals(0 to "", ask(words()))
        assertContentEquals(first, jar.readBytes(), "equal sources must give equal jars")

        write("Hops.kt", "fun hops(sensors: SensorData) = sensors.colour()")
        val (code, messages) = ask(words())
        assertEquals(1, code)
        assertContains(messages, Regex("""Hops\.kt:3:\d+: error: unresolved reference 'colour'"""))
        assertContentEquals(first, jar.readBytes(), "an error must not change the jar")

        schema("colour: float;")
        assertEquals(0, ask(words()).first)
        assertFalse(first.contentEquals(jar.readBytes()))
        write("More.kt", "fun more() = 1")
        assertEquals(0, ask(words()).first)
        assertEquals(setOf("swarm/HopsKt.class", "swarm/MoreKt.class"), classes("Kt.class"))
        programs.resolve("More.kt").deleteExisting()
        assertEquals(0, ask(words()).first)
        assertEquals(setOf("swarm/HopsKt.class"), classes("Kt.class"))

        for ((wrong, message) in listOf(
            listOf("--jar") to "--jar needs a value",
            emptyList<String>() to "exactly one --jar is required",
            words() + listOf("--colour", "red") to "unknown option --colour",
        )) {
            val answer = ask(wrong)
            assertEquals(1, answer.first)
            assertContains(answer.second, message)
        }
        client.destroyForcibly()
        assertTrue(server.waitFor(60, TimeUnit.SECONDS))
    }

    @Tag("repeats")
    @Test
    fun `one jar is compiled by a command, and an error is its exit code`() {
        write("Hops.kt", "fun hops() = 1")
        assertEquals(0, run(words()).first)
        JarFile(jar.toFile()).use {
            assertEquals("builtIn", it.manifest.mainAttributes.getValue("Collektive-Runtime"))
            assertEquals(64, it.manifest.mainAttributes.getValue("Collektive-Sources").length)
        }
        write("Hops.kt", "fun hops() =")
        assertEquals(1, run(words()).first)
        // The compiler cannot load this file as a plugin.
        val plugin = folder.resolve("plugin.jar")
        ZipOutputStream(Files.newOutputStream(plugin)).use {
            it.putNextEntry(ZipEntry("META-INF/services/org.jetbrains.kotlin.compiler.plugin.CompilerPluginRegistrar"))
            it.write("no.such.Plugin".encodeToByteArray())
        }
        val (code, messages) = run(words() + listOf("--kotlin", "-Xplugin=$plugin"))
        assertEquals(1, code)
        assertContains(messages, "no.such.Plugin")
    }

    private fun write(name: String, text: String) {
        if (!folder.resolve("swarm.fbs").exists()) schema("")
        programs.resolve(name).writeText("package swarm\n\n$text\n")
    }

    private fun schema(field: String) = folder.resolve("swarm.fbs").writeText(
        "namespace swarm;\ntable SensorData { intensity: float; $field }\nstruct ActuatorData { hops: float; }\n",
    )

    private fun words(): List<String> = listOf(
        "--flatc", System.getProperty("collektive.flatc"), "--include", "${Path.of(System.getProperty("collektive.root"), "schema")}",
        "--schema", "${folder.resolve("swarm.fbs")}", "--jar", "$jar", "--work", "${folder.resolve("work")}", "--source", "$programs",
        "--library", System.getProperty("java.class.path"), "--mark", "Collektive-Runtime:builtIn",
    )

    /** Sends a request to the process, and returns the exit code and the messages. */
    private fun ask(words: List<String>): Pair<Int, String> {
        val part = requests.resolve("a.part")
        part.writeBytes(words.joinToString("") { "$it\u0000" }.encodeToByteArray())
        Files.move(part, requests.resolve("a.request"))
        val response = requests.resolve("a.response")
        while (!response.exists()) Thread.sleep(5)
        val (code, messages) = response.readText().split('\n', limit = 2)
        response.deleteExisting()
        return code.toInt() to messages
    }

    private fun run(words: List<String>): Pair<Int, String> {
        val process = start(*command, *words.toTypedArray())
        val messages = process.inputStream.bufferedReader().readText()
        return process.waitFor() to messages
    }

    private val command = arrayOf(
        "${Path.of(System.getProperty("java.home"), "bin", "java")}",
        "-XX:+UseSerialGC",
        "-XX:TieredStopAtLevel=1",
        "-cp",
        System.getProperty("java.class.path"),
        "org.collektive.generator.CompileCommand",
    )

    private fun start(vararg words: String): Process = ProcessBuilder(*words).redirectErrorStream(true).start().also(started::add)

    private fun classes(ending: String): Set<String> =
        JarFile(jar.toFile()).use { file -> file.entries().asSequence().map { it.name }.filter { it.endsWith(ending) }.toSet() }
}
