package org.collektive.host

import java.net.URI
import java.nio.file.FileSystems
import java.nio.file.Files
import java.nio.file.Path
import javax.tools.ToolProvider
import kotlin.io.path.ExperimentalPathApi
import kotlin.io.path.copyToRecursively
import kotlin.io.path.createDirectories
import kotlin.io.path.createTempDirectory
import kotlin.io.path.extension
import kotlin.io.path.readText
import kotlin.io.path.walk
import kotlin.io.path.writeText
import org.collektive.generator.main as generate

/** Users' jars, generated and compiled as by a user. They are on no class path of the tests. */
@OptIn(ExperimentalPathApi::class)
internal object ProbeJars {
    private val root = Path.of(System.getProperty("collektive.root"))
    private val work = createTempDirectory("collektive-host-test").also { folder ->
        Runtime.getRuntime().addShutdownHook(Thread { folder.toFile().deleteRecursively() })
    }
    private val generated: Path by lazy { generate(work.resolve("generated"), "probe.fbs") }

    /** A jar with the schema `probe.ProbeSchema` and the programs "sum" and "probe". */
    val programs: Path by lazy { jar("programs", generated, root.resolve("jvm-host/host/src/test/programs")) }

    /** The same schema, and only the program "sum", which does no harm whatever its sensors say. */
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
        val both = generate(folder.resolve("generated"), "probe.fbs", "other.fbs")
        both.resolve("META-INF/services/org.collektive.frames.data.DataSchema").writeText("probe.ProbeSchema\nother.OtherSchema\n")
        both.resolve("other/Programs.java").writeText(java)
        return jar(folder.fileName.toString(), both, root.resolve("jvm-host/host/src/test/programs"))
    }

    /** The schema of [programs], with [java] as `probe/Bad.java`. */
    fun withClass(java: String): Path {
        val folder = createTempDirectory(work, "bad")
        folder.resolve("probe").createDirectories().resolve("Bad.java").writeText(java)
        return jar(folder.fileName.toString(), generated, folder)
    }

    private fun generate(output: Path, vararg schemas: String): Path {
        for (schema in schemas) {
            generate(
                arrayOf(
                    "--flatc",
                    System.getProperty("collektive.flatc"),
                    "--schema",
                    root.resolve("jvm-host/host/src/test/schema/$schema").toString(),
                    "--include",
                    root.resolve("schema").toString(),
                    "--java",
                    output.createDirectories().toString(),
                ),
            )
        }
        return output
    }

    private fun jar(name: String, vararg sources: Path): Path {
        val classes = createTempDirectory(work, "classes")
        val files = sources.flatMap { it.walk().filter { file -> file.extension == "java" } }.map(Path::toString)
        val options = listOf("-d", classes.toString(), "-cp", System.getProperty("java.class.path"), "-nowarn", "-proc:none")
        val code = ToolProvider.getSystemJavaCompiler().run(null, null, null, *(options + files).toTypedArray())
        check(code == 0) { "javac failed" }
        sources.map { it.resolve("META-INF") }.filter(Files::exists).forEach {
            it.copyToRecursively(classes.resolve("META-INF").createDirectories(), followLinks = false, overwrite = true)
        }
        val jar = work.resolve("$name.jar")
        FileSystems.newFileSystem(URI.create("jar:${jar.toUri()}"), mapOf("create" to "true")).use { zip ->
            classes.copyToRecursively(zip.getPath("/"), followLinks = false, overwrite = true)
        }
        return jar
    }
}
