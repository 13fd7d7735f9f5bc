package org.collektive.tools.record

import org.collektive.frames.MalformedFrameException
import org.collektive.host.library.AggregateRuntime
import org.collektive.host.programs.JarBytes
import org.collektive.host.shim.HostException
import java.io.IOException
import java.io.PrintStream
import java.nio.file.Files
import java.nio.file.InvalidPathException
import java.nio.file.Path
import java.nio.file.StandardCopyOption.REPLACE_EXISTING
import java.util.UUID
import kotlin.system.exitProcess

private const val EQUAL = 0
private const val DIFFERENT = 1
private const val ERROR = 2

/** The exit code of the process for [DIFFERENT]. A JVM that does not start exits with 1. */
private const val EXIT_DIFFERENT = 3

/** The options of `replay` that have a value. */
private val OPTIONS = setOf("--programs", "--own", "--runtime", "--runtime-jars", "--out")

/**
 * Runs `replay FILE [--trust] [--own FOLDER]... [--programs JAR]... [--runtime NAME] [--runtime-jars FOLDER] [--out RECORD]` or `diff A B`
 * on a standard JVM, without Unity.
 *
 * `--own` is a folder that contains one file per jar that the user has run, named by its SHA-256. `replay` runs the jars of the record only
 * if the user has run them, or with `--trust`. `diff` never runs them.
 *
 * The exit code is 0 without differences, 3 with differences, and 2 if a record or jar cannot be used, or a record only partly.
 */
public fun main(arguments: Array<String>) {
    val results = System.out
    // Keeps the output of programs out of the results.
    System.setOut(System.err)
    val code = records(arguments.asList(), results, System.err)
    exitProcess(if (code == DIFFERENT) EXIT_DIFFERENT else code)
}

internal fun records(arguments: List<String>, results: PrintStream, messages: PrintStream): Int {
    val report = Report(results, messages)
    return try {
        when (arguments.firstOrNull()) {
            "replay" -> replay(arguments.drop(1), report)

            "diff" -> diff(arguments.drop(1), report)

            else -> throw InvalidRecordException(
                "usage: replay FILE [--trust] [--own FOLDER]... [--programs JAR]... [--runtime NAME] [--runtime-jars FOLDER] " +
                    "[--out RECORD] | diff A B",
            )
        }
    } catch (e: RecordException) {
        failure(messages, e)
    } catch (e: HostException) {
        failure(messages, e)
    } catch (e: MalformedFrameException) {
        failure(messages, e)
    } catch (e: IOException) {
        failure(messages, e)
    }
}

private fun replay(arguments: List<String>, report: Report): Int {
    val file = arguments.firstOrNull() ?: throw InvalidRecordException("replay: the path of the record is missing")
    val isTrusted = "--trust" in arguments
    val options = (arguments.drop(1) - "--trust").chunked(2).map { option ->
        if (option.first() !in OPTIONS || option.size < 2) {
            throw InvalidRecordException("replay: '${option.first()}' is not an option, or its value is missing")
        }
        option[0] to option[1]
    }
    val jars = options.filter { it.first == "--programs" }.map { JarBytes.read(it.second) }
    val last = options.toMap()
    Record.open(path(file)).use { record ->
        report.line(describe(record))
        for (jar in jars) report.line("programs of ${jar.path}, SHA-256 ${sha256(jar)}")
        val known = KnownPrograms(options.filter { it.first == "--own" }.map { path(it.second) })
        val check: (List<JarBytes>) -> Unit = { if (jars.isEmpty() && !isTrusted) known.require(it, file) }
        check(record.jars)
        val request = record.settings.unpack()
        last["--runtime"]?.let { request.runtime = runtime(it).ordinal }
        val runtimeJars = last["--runtime-jars"]
        if (runtimeJars == null && !request.runtimeJars.isNullOrEmpty() && !isTrusted) {
            throw InvalidRecordException(
                "$file uses the runtime jars in ${request.runtimeJars}, and a replay runs their code with your permissions: " +
                    "set another folder with --runtime-jars FOLDER, or add --trust if you trust the author of the record",
            )
        }
        runtimeJars?.let { request.runtimeJars = it }
        val programs = jars.ifEmpty { record.jars }
        // The settings that the record of the replay contains.
        request.jars = programs.map(JarBytes::path).toTypedArray()
        request.record = last["--out"].orEmpty()
        // With other programs, a recorded reload loads these again.
        val reloaded: (RecordedStep) -> List<JarBytes> = { step -> jars.ifEmpty { step.jars.also(check) } }
        val run = { out: Path? -> Replay(record, request, programs, reloaded, out?.toString(), report).run() }
        return code(last["--out"]?.let { replaceWhenComplete(path(it), run) } ?: run(null))
    }
}

/** Calls [write] with a temporary file, which replaces [file], or a link of that name, unless [write] fails. Writes devices and pipes directly. */
private fun replaceWhenComplete(file: Path, write: (Path) -> Boolean): Boolean {
    if (Files.exists(file) && !Files.isRegularFile(file)) return write(file)
    val part = file.resolveSibling("${file.fileName}.${UUID.randomUUID()}.part")
    // After a signal, the JVM does not execute the `finally` block.
    part.toFile().deleteOnExit()
    try {
        return write(part).also { Files.move(part, file, REPLACE_EXISTING) }
    } finally {
        Files.deleteIfExists(part)
    }
}

private fun runtime(name: String): AggregateRuntime = AggregateRuntime.entries.find { it.key == name }
    ?: throw InvalidRecordException("replay: unknown runtime '$name'; use one of ${AggregateRuntime.entries.joinToString { it.key }}")

private fun diff(arguments: List<String>, report: Report): Int {
    if (arguments.size != 2) throw InvalidRecordException("diff: the paths of two records are required")
    Record.open(path(arguments[0])).use { left ->
        Record.open(path(arguments[1])).use { right -> return code(RecordDiff(left, right, report).run()) }
    }
}

private fun describe(record: Record): String {
    val settings = record.settings
    val jars = record.jars.joinToString { "${it.path.substringAfterLast('/').substringAfterLast('\\')} (SHA-256 ${sha256(it)})" }
    return "schema ${settings.schema()}, program '${settings.program().orEmpty()}', seed ${settings.seed().toULong()}, $jars, " +
        "${AggregateRuntime.of(settings.runtime()).title}; " +
        "recorded with ${record.head.trim().replace("\n", ", ")}"
}

private fun path(name: String): Path = try {
    Path.of(name)
} catch (_: InvalidPathException) {
    throw InvalidRecordException("'$name' is not a path")
}

private fun code(isEqual: Boolean) = if (isEqual) EQUAL else DIFFERENT

private fun failure(messages: PrintStream, e: Exception): Int {
    messages.println(printable("collektive: ${e.message}"))
    return ERROR
}
