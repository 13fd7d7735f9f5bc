package org.collektive.generator

import java.nio.file.Path

/** Runs `flatc` and forwards its messages, which name the file and the line. */
internal class Flatc(private val executable: Path, private val includes: List<Path>) {
    /** Writes the binary form of [schema], with comments, attributes and paths, to the folder [output]. */
    fun fullBinarySchema(schema: Path, output: Path) {
        run(schema, output, "--binary", "--schema", "--bfbs-comments", "--bfbs-builtins", "--bfbs-absolute-paths")
    }

    /** Writes the binary form of [schema] to the folder [output], with file paths relative to the folder of [schema]. */
    fun binarySchema(schema: Path, output: Path) {
        run(schema, output, "--binary", "--schema")
    }

    /** Writes C# readers of the types that [schema] itself defines, without included ones. */
    fun csharp(schema: Path, output: Path) {
        run(schema, output, "--csharp", "--no-warnings")
    }

    /** Writes Java readers of the types that [schema] itself defines, without included ones. */
    fun java(schema: Path, output: Path) {
        run(schema, output, "--java", "--no-warnings")
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
        val messages = withoutStyle(process.inputStream.bufferedReader().readText())
        val code = process.waitFor()
        if (code > SIGNAL) {
            throw GeneratorException(
                "${schema.fileName}:1: flatc crashed on this file (signal ${code - SIGNAL}); simplify the schema",
            )
        }
        if (code != 0) throw GeneratorException("flatc rejects ${schema.fileName}:\n${withPositionsFirst(messages)}")
        if (messages.isNotEmpty()) System.err.println(messages)
    }

    internal companion object {
        /** A process that a signal ended exits with this code plus the number of the signal. */
        private const val SIGNAL = 128

        /** flatc's warning about naming style, which consists of a heading and a line. */
        private val STYLE = Regex("""(?:warning:\s*)?\R.*should be lowercase snake_case.*""")

        private val ERROR = Regex("""(?m)^(?:error:)?\s*(\S.*?):(\d+): (\d+): (error|warning): (.*?)(?:, originally at: (.+):(\d+))?$""")

        /** Returns [messages] without warnings about naming style, because schemas may use the names of Alchemist's molecules for fields. */
        fun withoutStyle(messages: String): String = STYLE.replace(messages, "").trim()

        /** Returns [messages] with the position of each error first, in the format that terminals and editors recognise. */
        fun withPositionsFirst(messages: String): String = ERROR.replace(messages) {
            val (file, line, column, kind, text, origin, originLine) = it.destructured
            when {
                origin.isNotEmpty() -> "$origin:$originLine: $kind: $text"
                column == "0" -> "$file:$line: $kind: $text"
                else -> "$file:$line:$column: $kind: $text"
            }
        }
    }
}
