package org.collektive.generator

import java.io.IOException
import java.nio.file.Files
import java.nio.file.Path
import kotlin.io.path.ExperimentalPathApi
import kotlin.io.path.deleteRecursively
import kotlin.system.exitProcess

/** Generates code of users' schemas for C# and the JVM; see [Arguments.USAGE]. On an error it prints a message and exits with code 1. */
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
    for (schema in arguments.schemas) {
        val work = Files.createTempDirectory("collektive-generator")
        try {
            generate(arguments, schema.toAbsolutePath().normalize(), work)
        } finally {
            work.deleteRecursively()
        }
    }
}

private fun generate(arguments: Arguments, file: Path, work: Path) {
    val include = arguments.include.toAbsolutePath().normalize()
    val flatc = Flatc(arguments.flatc.toAbsolutePath(), listOf(include, file.parent))
    // flatc prints its usage for files that are not text.
    SchemaText.read(file)
    flatc.fullBinarySchema(file, work)
    var reader = SchemaReader(Files.readAllBytes(work.resolve(binary(file))), file, include.resolve(CORE_TYPES))
    arguments.layouts?.let { folder ->
        val tables = reader.tables()
        val name = Layouts.name(file.fileName.toString(), tables.first().name.namespace)
        val model = Layouts.model(file.fileName.toString(), tables)
        OutputFolder(folder).apply { add("${path(name)}.java", Templates.render("Layouts.java", model)) }.write()
    }
    if (arguments.csharp == null && arguments.jvm == null) return
    val addition = reader.missingSensorData()
    val complete = if (addition.isEmpty()) file else Files.createDirectories(work.resolve("complete")).resolve(file.fileName)
    if (complete != file) {
        Files.writeString(complete, Files.readString(file) + addition)
        flatc.fullBinarySchema(complete, work)
        reader = SchemaReader(Files.readAllBytes(work.resolve(binary(file))), complete, include.resolve(CORE_TYPES))
    }
    val schema = reader.read()
    val files = reader.files.map { if (it == complete) file else it }
    val copies = SanitizedSchemas(files, include.resolve(CORE_TYPES), work, mapOf(file to addition))
    val sanitized = Flatc(arguments.flatc.toAbsolutePath(), listOf(copies.core, copies.of(file).parent))
    val csharpFolder = arguments.csharp?.let(::OutputFolder)?.apply { checkNamespace("${path(schema.name)}.cs") }
    val jvmFolder = arguments.jvm?.let(::OutputFolder)?.apply { checkNamespace("${path(schema.name)}.kt") }

    csharpFolder?.let { output ->
        val csharp = CSharp(schema)
        files.forEach { sanitized.csharp(copies.of(it), work.resolve("csharp")) }
        output.copy(work.resolve("csharp")) { path, text -> if (csharp.reads(path)) CSharp.adapt(text) else null }
        for ((name, model) in csharp.mirrors()) output.add("${path(name)}.cs", Templates.render("Mirror.cs", model))
        for ((name, model) in csharp.drafts()) output.add("${path(name)}.cs", Templates.render("Draft.cs", model))
        output.addSchema("${path(schema.name)}.cs", Templates.render("Schema.cs", csharp.schema()))
    }
    jvmFolder?.let { output ->
        val kotlin = Kotlin(schema)
        files.forEach { sanitized.java(copies.of(it), work.resolve("java")) }
        // Programs only write the actuator data.
        output.copy(work.resolve("java")) { path, text -> text.takeIf { path != "${path(schema.actuator.name)}.java" } }
        for ((name, model) in kotlin.values()) output.add("${path(name)}.kt", Templates.render("Value.kt", model))
        output.addSchema("${path(schema.name)}.kt", Templates.render("Schema.kt", kotlin.schema()))
        sanitized.binarySchema(copies.of(file), work.resolve("portable"))
        output.add("META-INF/collektive/${schema.name}.bfbs", Files.readAllBytes(work.resolve("portable").resolve(binary(file))))
        output.addLine(SERVICES, "${schema.name}") { output.contains("${it.replace('.', '/')}.kt") }
    }
    csharpFolder?.write()
    jvmFolder?.write()
}

private const val SERVICES = "META-INF/services/org.collektive.frames.data.DataSchema"

private fun binary(schema: Path): String = schema.fileName.toString().substringBeforeLast('.') + ".bfbs"

private fun path(name: TypeName): String = name.toString().replace('.', '/')
