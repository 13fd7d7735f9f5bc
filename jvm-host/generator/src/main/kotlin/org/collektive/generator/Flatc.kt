package org.collektive.generator

import java.nio.file.Path

/** Runs `flatc`, and passes on its messages, which name file and line. */
internal class Flatc(private val executable: Path, private val includes: List<Path>) {
    /** Writes the binary form of [schema], comments included, to the folder [output]. */
    fun binarySchema(schema: Path, output: Path) {
        run(schema, output, "--binary", "--schema", "--bfbs-comments", "--bfbs-absolute-paths")
    }

    /** Writes C# readers of the types that [schema] itself defines, without included ones. */
    fun csharp(schema: Path, output: Path) {
        run(schema, output, "--csharp", "--no-warnings")
    }

    /** Writes Java readers and object types of the types that [schema] itself defines, without included ones. */
    fun java(schema: Path, output: Path) {
        run(schema, output, "--java", "--gen-object-api", "--no-warnings")
    }

    private fun run(schema: Path, output: Path, vararg options: String) {
        val command = buildList {
            add(executable.toString())
            addAll(options)
            for (include in includes) {
                add("-I")
                add(include.toString())
            }
            add("-o")
            add(output.toString())
            add(schema.toString())
        }
        val process = ProcessBuilder(command).redirectErrorStream(true).start()
        process.outputStream.close()
        val messages = process.inputStream.bufferedReader().readText().trim()
        if (process.waitFor() != 0) throw GeneratorException("flatc refuses ${schema.fileName}:\n$messages")
        if (messages.isNotEmpty()) System.err.println(messages)
    }
}
