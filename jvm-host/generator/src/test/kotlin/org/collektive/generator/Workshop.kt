package org.collektive.generator

import org.collektive.api.schema.DataSchema
import java.net.URLClassLoader
import java.nio.file.Files
import java.nio.file.Path
import javax.tools.ToolProvider
import kotlin.test.assertEquals

/** Runs the generator and compiles what it made. */
internal object Workshop {
    val root: Path = Path.of(System.getProperty("collektive.root"))
    val flatc: Path = Path.of(System.getProperty("collektive.flatc"))
    val testSchemas: Path = root.resolve("schema/test")

    private val work = Files.createTempDirectory("generator-test").also { folder ->
        Runtime.getRuntime().addShutdownHook(Thread { folder.toFile().deleteRecursively() })
    }

    /** A folder of its own, which goes when the tests are over. */
    fun newFolder(): Path = Files.createTempDirectory(work, "")

    /** Generates from a schema of this text, with the right `include` before it. */
    fun generate(text: String, name: String = "user.fbs"): Path {
        val folder = newFolder()
        val schema = Files.writeString(folder.resolve(name), text)
        generate(schema, folder.resolve("out"))
        return folder.resolve("out")
    }

    /** Generates C# and Java into the folders `csharp` and `java` of [output]. */
    fun generate(schema: Path, output: Path) {
        generate(Arguments(flatc, schema, root.resolve("schema"), output.resolve("csharp"), output.resolve("java")))
    }

    /** The Java side of a schema below `schema/test`, compiled and loaded. */
    fun load(schema: String, name: String): DataSchema {
        val output = newFolder()
        generate(testSchemas.resolve(schema), output)
        val sources = files(output.resolve("java")).filter { it.toString().endsWith(".java") }
        val classes = Files.createDirectories(output.resolve("classes"))
        val compiler = ToolProvider.getSystemJavaCompiler()
        val options = arrayOf("-d", "$classes", "-cp", System.getProperty("java.class.path"), "-Xlint:all", "-Werror")
        assertEquals(0, compiler.run(null, null, null, *options, *sources.map { it.toString() }.toTypedArray()), "javac")
        val loader = URLClassLoader(arrayOf(classes.toUri().toURL()), javaClass.classLoader)
        return loader.loadClass(name).getConstructor().newInstance() as DataSchema
    }

    fun files(folder: Path): List<Path> = Files.walk(folder).use { paths -> paths.filter(Files::isRegularFile).sorted().toList() }

    val blocks: DataSchema by lazy { load("blocks.fbs", "test.blocks.BlocksSchema") }
    val features: DataSchema by lazy { load("features.fbs", "test.features.FeaturesSchema") }
    val globals: DataSchema by lazy { load("globals.fbs", "test.globals.GlobalsSchema") }
}
