package org.collektive.tools.record

import org.collektive.frames.MalformedFrameException
import org.collektive.host.programs.JarBytes
import org.collektive.host.shim.HostException
import java.io.IOException
import java.io.PrintStream
import java.nio.file.InvalidPathException
import java.nio.file.Path
import kotlin.system.exitProcess

private const val EQUAL = 0
private const val DIFFERENT = 1
private const val TROUBLE = 2

/**
 * Runs `replay FILE [--trust] [--own FOLDER]... [--programs JAR]...` or `diff A B` on a plain JVM, without Unity.
 *
 * `--own` names a folder with a file for each jar that the user has run, named by its SHA-256: `replay` runs the record's jars only if they
 * are among them, or with `--trust`. `diff` never runs them.
 *
 * Exit code 0: no difference; 1: a difference; 2: a record or a jar cannot be used, or a record not to its end.
 */
public fun main(arguments: Array<String>) {
    val results = System.out
    // Keeps the output of programs out of the results.
    System.setOut(System.err)
    exitProcess(records(arguments.asList(), results, System.err))
}

internal fun records(arguments: List<String>, results: PrintStream, messages: PrintStream): Int {
    val report = Report(results, messages)
    return try {
        when (arguments.firstOrNull()) {
            "replay" -> replay(arguments.drop(1), report)
            "diff" -> diff(arguments.drop(1), report)
            else -> throw RecordRefused("usage: replay FILE [--trust] [--own FOLDER]... [--programs JAR]... | diff A B")
        }
    } catch (e: RecordException) {
        trouble(messages, e)
    } catch (e: HostException) {
        trouble(messages, e)
    } catch (e: MalformedFrameException) {
        trouble(messages, e)
    } catch (e: IOException) {
        trouble(messages, e)
    }
}

private fun replay(arguments: List<String>, report: Report): Int {
    val file = arguments.firstOrNull() ?: throw RecordRefused("replay: name a record")
    val isTrusted = "--trust" in arguments
    val options = (arguments.drop(1) - "--trust").chunked(2).map { option ->
        if (option.first() !in setOf("--programs", "--own") || option.size < 2) {
            throw RecordRefused("replay: '${option.first()}' is no option, or lacks its value")
        }
        option.first() to option[1]
    }
    val jars = options.filter { it.first == "--programs" }.map { JarBytes.read(it.second) }
    Record.open(path(file)).use { record ->
        report.line(describe(record))
        for (jar in jars) report.line("programs of ${jar.path}, SHA-256 ${sha256(jar)}")
        if (jars.isEmpty() && !isTrusted) OwnPrograms(options.filter { it.first == "--own" }.map { path(it.second) }).require(record, file)
        return code(Replay(record, jars, report).run())
    }
}

private fun diff(arguments: List<String>, report: Report): Int {
    if (arguments.size != 2) throw RecordRefused("diff: name two records")
    Record.open(path(arguments[0])).use { left ->
        Record.open(path(arguments[1])).use { right -> return code(RecordDiff(left, right, report).run()) }
    }
}

private fun describe(record: Record): String {
    val settings = record.settings
    val jars = record.jars.joinToString { "${it.path.substringAfterLast('/').substringAfterLast('\\')} (SHA-256 ${sha256(it)})" }
    val text = "schema ${settings.schema()}, program '${settings.program().orEmpty()}', seed ${settings.seed().toULong()}, $jars; " +
        "recorded with ${record.head.trim().replace("\n", ", ")}"
    // A record must not steer the terminal.
    return text.map { if (it.isISOControl()) '?' else it }.joinToString("")
}

private fun path(name: String): Path = try {
    Path.of(name)
} catch (_: InvalidPathException) {
    throw RecordRefused("'$name' is not a path")
}

private fun code(isEqual: Boolean) = if (isEqual) EQUAL else DIFFERENT

private fun trouble(messages: PrintStream, e: Exception): Int {
    messages.println("collektive: ${e.message}")
    return TROUBLE
}
