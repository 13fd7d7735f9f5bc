package org.collektive.generator

import java.nio.file.Files
import java.nio.file.Path

/** Runs the generator in temporary folders. */
internal object Fixture {
    val root: Path = Path.of(System.getProperty("collektive.root"))
    val flatc: Path = Path.of(System.getProperty("collektive.flatc"))
    val testSchemas: Path = root.resolve("schema/test")

    private val work = Files.createTempDirectory("generator-test").also { folder ->
        Runtime.getRuntime().addShutdownHook(Thread { folder.toFile().deleteRecursively() })
    }

    /** Creates a temporary folder, which is deleted after the tests. */
    fun newFolder(): Path = Files.createTempDirectory(work, "")

    /** Generates code from a schema that consists of an `include` of the core types and [text]. */
    fun generate(text: String, name: String = "user.fbs"): Path {
        val folder = newFolder()
        val schema = Files.writeString(folder.resolve(name), text)
        generate(schema, folder.resolve("out"))
        return folder.resolve("out")
    }

    /** Generates code into the folders `csharp` and `jvm` of [output]. */
    fun generate(schema: Path, output: Path) {
        generate(Arguments(flatc, listOf(schema), root.resolve("schema"), output.resolve("csharp"), output.resolve("jvm")))
    }

    fun files(folder: Path): List<Path> = Files.walk(folder).use { paths -> paths.filter(Files::isRegularFile).sorted().toList() }
}
