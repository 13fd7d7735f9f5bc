package org.collektive.host

import org.collektive.frames.data.GeneratedCode
import java.net.URI
import java.nio.file.FileSystems
import java.nio.file.Path
import kotlin.io.path.ExperimentalPathApi
import kotlin.io.path.copyToRecursively
import kotlin.io.path.createDirectories
import kotlin.io.path.createTempDirectory
import kotlin.io.path.readText
import kotlin.io.path.writeText

/** Jars of programs, generated and compiled as by a user. They are not on the class path of the tests. */
@OptIn(ExperimentalPathApi::class)
internal object ProbeJars {
    private val root = Path.of(System.getProperty("collektive.root"))
    private val work = createTempDirectory("collektive-host-test").also { folder ->
        Runtime.getRuntime().addShutdownHook(Thread { folder.toFile().deleteRecursively() })
    }
    private val generated: Path by lazy { compile(generate(work.resolve("generated"), "probe.fbs")) }
    private val both: Path by lazy { compile(generate(work.resolve("both"), "probe.fbs", "other.fbs")) }

    /** A jar with the schema `probe.ProbeSchema` and the programs "sum" and "probe". */
    val programs: Path by lazy { jar("programs", generated, root.resolve("jvm-host/host/src/test/programs")) }

    /** The same schema with only the program "sum", which is harmless for any sensor data. */
    val harmless: Path by lazy {
        val probe = root.resolve("jvm-host/host/src/test/programs/probe/Programs.java").readText()
        val folder = createTempDirectory(work, "harmless")
        val end = probe.indexOf("  @Program(name = \"probe\")")
        folder.resolve("probe").createDirectories().resolve("Programs.java").writeText(probe.substring(0, end) + "}\n")
        jar("harmless", generated, folder)
    }

    /** [programs] with `other.OtherSchema` added, and [java] as `other/Programs.java`. */
    fun withOtherSchema(java: String): Path {
        val folder = createTempDirectory(work, "both")
        val others = folder.resolve("programs").also { it.resolve("other").createDirectories().resolve("Programs.java").writeText(java) }
        return jar(folder.fileName.toString(), both, root.resolve("jvm-host/host/src/test/programs"), others)
    }

    /** The schema of [programs], with [java] as the class `probe.[name]`. */
    fun withClass(java: String, name: String = "Bad"): Path {
        val folder = createTempDirectory(work, "class")
        folder.resolve("probe").createDirectories().resolve("$name.java").writeText(java)
        return jar(folder.fileName.toString(), generated, folder)
    }

    private fun generate(output: Path, vararg schemas: String): Path {
        for (schema in schemas) GeneratedCode.generate(root.resolve("jvm-host/host/src/test/schema/$schema"), output)
        return output
    }

    /** The classes of [generated] code. */
    private fun compile(generated: Path): Path = createTempDirectory(work, "compiled").also { GeneratedCode.compile(generated, it) }

    /** A jar of [compiled] code and the Java in the folders [programs]. */
    private fun jar(name: String, compiled: Path, vararg programs: Path): Path {
        val classes = createTempDirectory(work, "classes")
        compiled.copyToRecursively(classes, followLinks = false, overwrite = true)
        GeneratedCode.javac(programs.asList(), classes, "-nowarn")
        val jar = work.resolve("$name.jar")
        FileSystems.newFileSystem(URI.create("jar:${jar.toUri()}"), mapOf("create" to "true")).use { zip ->
            classes.copyToRecursively(zip.getPath("/"), followLinks = false, overwrite = true)
        }
        return jar
    }
}
