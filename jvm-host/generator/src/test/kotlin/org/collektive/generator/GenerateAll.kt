package org.collektive.generator

import java.nio.file.Path
import kotlin.io.path.isDirectory
import kotlin.io.path.listDirectoryEntries
import kotlin.io.path.name

/**
 * Generates code for `schema/test/fuzz.py`, from each `FOLDER/NAME/...fbs` into `FOLDER/csharp` and `FOLDER/jvm`.
 *
 * Prints a line for each schema with three columns, separated by tabs: the name, then `accepted`, `rejected` or `crashed`, and then the
 * schema's class or the message.
 */
internal object GenerateAll {
    @JvmStatic
    fun main(arguments: Array<String>) {
        val (flatc, include, folder) = arguments.map(Path::of)
        for (case in folder.resolve("cases").listDirectoryEntries().filter { it.isDirectory() }.sortedBy { it.name }) {
            val schema = case.listDirectoryEntries("*.fbs").single()
            val given = Arguments(flatc, listOf(schema), include, folder.resolve("csharp"), folder.resolve("jvm"))
            val (outcome, text) = outcome { generate(given) }
            println("${case.name}\t$outcome\t${text.replace('\n', ' ').replace('\t', ' ')}")
        }
    }

    private fun outcome(generate: () -> Unit): Pair<String, String> = try {
        generate()
        "accepted" to ""
    } catch (e: GeneratorException) {
        "rejected" to e.message.orEmpty()
    } catch (e: Throwable) {
        "crashed" to e.stackTraceToString().take(1000)
    }
}
