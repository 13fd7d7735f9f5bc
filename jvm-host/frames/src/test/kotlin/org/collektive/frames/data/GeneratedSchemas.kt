package org.collektive.frames.data

import java.net.URLClassLoader
import java.nio.ByteBuffer
import java.nio.file.Files
import java.nio.file.Path
import kotlin.test.assertEquals

/**
 * The compiled and loaded code of the schemas below `schema/test`. It includes flatc's object API, in packages below `objects`.
 */
internal object GeneratedSchemas {
    val blocks: DataSchema by lazy { load("blocks.fbs", "test.blocks.BlocksSchema") }
    val features: DataSchema by lazy { load("features.fbs", "test.features.FeaturesSchema") }
    val globals: DataSchema by lazy { load("globals.fbs", "test.globals.GlobalsSchema") }

    private val root = Path.of(System.getProperty("collektive.root"))
    private val work = Files.createTempDirectory("frames-test").also { folder ->
        Runtime.getRuntime().addShutdownHook(Thread { folder.toFile().deleteRecursively() })
    }

    /** Generates, compiles and loads the code of the schema with the text [schema], and returns its class [name]. */
    fun of(schema: String, name: String): DataSchema =
        load(Files.writeString(Files.createTempDirectory(work, "schema").resolve("user.fbs"), schema), name)

    /** Returns the class of flatc's object API for [type] of the schema. */
    fun flatc(schema: DataSchema, type: String): Class<*> = schema.javaClass.classLoader.loadClass("objects.$type")

    /** Reads an object of [type] at the position [place] of [frame] with flatc's object API. */
    fun unpacked(schema: DataSchema, type: String, frame: ByteBuffer, place: Int): Any {
        val reader = flatc(schema, type)
        val view = reader.getMethod("__assign", Int::class.java, ByteBuffer::class.java)
            .invoke(reader.getConstructor().newInstance(), place, frame)
        return reader.getMethod("unpack").invoke(view)
    }

    private fun load(schema: String, name: String): DataSchema = load(root.resolve("schema/test/$schema"), name)

    private fun load(schema: Path, name: String): DataSchema {
        val code = Files.createTempDirectory(work, "code")
        val classes = Files.createTempDirectory(work, "classes")
        GeneratedCode.generate(schema, code)
        GeneratedCode.compile(code, classes)
        val objects = Files.createTempDirectory(work, "objects")
        val flatc = ProcessBuilder(
            System.getProperty("collektive.flatc"), "--java", "--gen-object-api", "--gen-all", "--no-warnings",
            "--java-package-prefix", "objects", "-I", "${root.resolve("schema")}", "-o", "$objects", "$schema",
        )
        assertEquals(0, flatc.inheritIO().start().waitFor(), "flatc must succeed")
        GeneratedCode.javac(listOf(objects), classes)
        val loader = URLClassLoader(arrayOf(classes.toUri().toURL()), javaClass.classLoader)
        return loader.loadClass(name).getConstructor().newInstance() as DataSchema
    }
}
