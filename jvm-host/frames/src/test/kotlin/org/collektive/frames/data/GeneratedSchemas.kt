package org.collektive.frames.data

import java.net.URLClassLoader
import java.nio.file.Files
import java.nio.file.Path
import javax.tools.ToolProvider
import kotlin.test.assertEquals
import org.collektive.generator.main as generate

/** Generated code of the schemas below `schema/test`, compiled and loaded. */
internal object GeneratedSchemas {
    val blocks: DataSchema by lazy { load("blocks.fbs", "test.blocks.BlocksSchema") }
    val features: DataSchema by lazy { load("features.fbs", "test.features.FeaturesSchema") }
    val globals: DataSchema by lazy { load("globals.fbs", "test.globals.GlobalsSchema") }

    private val root = Path.of(System.getProperty("collektive.root"))
    private val work = Files.createTempDirectory("frames-test").also { folder ->
        Runtime.getRuntime().addShutdownHook(Thread { folder.toFile().deleteRecursively() })
    }

    /** The schema of the text [schema], whose generated code has the class [name]. */
    fun of(schema: String, name: String): DataSchema =
        load(Files.writeString(Files.createTempDirectory(work, "schema").resolve("user.fbs"), schema), name)

    private fun load(schema: String, name: String): DataSchema = load(root.resolve("schema/test/$schema"), name)

    private fun load(schema: Path, name: String): DataSchema {
        val java = Files.createTempDirectory(work, "java")
        val classes = Files.createTempDirectory(work, "classes")
        generate(
            arrayOf(
                "--flatc",
                System.getProperty("collektive.flatc"),
                "--schema",
                "$schema",
                "--include",
                root.resolve("schema").toString(),
                "--java",
                java.toString(),
            ),
        )
        val sources = Files.walk(java).use { paths -> paths.filter { it.toString().endsWith(".java") }.sorted().toList() }
        val options = arrayOf("-d", "$classes", "-cp", System.getProperty("java.class.path"), "-Xlint:all", "-Werror")
        assertEquals(
            0,
            ToolProvider.getSystemJavaCompiler().run(
                null,
                null,
                null,
                *options,
                *sources.map {
                    it.toString()
                }.toTypedArray(),
            ),
            "javac",
        )
        val loader = URLClassLoader(arrayOf(classes.toUri().toURL()), javaClass.classLoader)
        return loader.loadClass(name).getConstructor().newInstance() as DataSchema
    }
}
