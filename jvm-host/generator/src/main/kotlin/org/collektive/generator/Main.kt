package org.collektive.generator

import java.io.IOException
import java.nio.file.Files
import java.nio.file.Path
import kotlin.io.path.ExperimentalPathApi
import kotlin.io.path.deleteRecursively
import kotlin.system.exitProcess

/** Generates C# and Java from a user's schema; see [Arguments.USAGE]. On an error it prints a message and exits with code 1. */
public fun main(arguments: Array<String>) {
    try {
        generate(Arguments.parse(arguments))
    } catch (e: GeneratorException) {
        System.err.println("generate: ${e.message}")
        exitProcess(1)
    } catch (e: IOException) {
        System.err.println("generate: $e")
        exitProcess(1)
    }
}

@OptIn(ExperimentalPathApi::class)
internal fun generate(arguments: Arguments) {
    val work = Files.createTempDirectory("collektive-generator")
    try {
        generate(arguments, work)
    } finally {
        work.deleteRecursively()
    }
}

private fun generate(arguments: Arguments, work: Path) {
    val file = arguments.schema.toAbsolutePath().normalize()
    val include = arguments.include.toAbsolutePath().normalize()
    val flatc = Flatc(arguments.flatc.toAbsolutePath(), listOf(include, file.parent))
    flatc.binarySchema(file, work)
    val binary = Files.readAllBytes(work.resolve(file.fileName.toString().substringBeforeLast('.') + ".bfbs"))
    val reader = SchemaReader(binary, file, include.resolve(CORE_TYPES))
    arguments.layouts?.let { folder ->
        val tables = reader.tables()
        val name = Layouts.name(file.fileName.toString(), tables.first().name.namespace)
        OutputFolder(folder).write("${path(name)}.java", Templates.render("Layouts.java", Layouts.model(file.fileName.toString(), tables)))
    }
    if (arguments.csharp == null && arguments.java == null) return
    val schema = reader.read()

    arguments.csharp?.let { folder ->
        val output = OutputFolder(folder)
        reader.files.forEach { flatc.csharp(it, work.resolve("csharp")) }
        output.copy(work.resolve("csharp")) { _, text -> CSharp.defineSymbols(text) }
        output.write("${path(schema.name)}.cs", Templates.render("Schema.cs", CSharp.model(schema)))
    }
    arguments.java?.let { folder ->
        val output = OutputFolder(folder)
        reader.files.forEach { flatc.java(it, work.resolve("java")) }
        output.copy(work.resolve("java")) { path, text -> Java.keepZeros(schema, path, text) }
        output.write("${path(schema.name)}.java", Templates.render("Schema.java", Java.model(schema)))
        output.addLine(SERVICES, "${schema.name}") { output.holds("${it.replace('.', '/')}.java") }
    }
}

private const val SERVICES = "META-INF/services/org.collektive.frames.data.DataSchema"

private fun path(name: TypeName): String = name.toString().replace('.', '/')
