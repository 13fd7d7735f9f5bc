package org.collektive.generator

import java.io.ByteArrayOutputStream
import java.io.PrintStream
import java.nio.file.Files
import java.nio.file.Path
import java.nio.file.StandardCopyOption
import kotlin.io.path.deleteExisting
import kotlin.io.path.name
import kotlin.io.path.readText
import kotlin.io.path.writeBytes

/**
 * Compiles the requests in a [folder], one after the other, so that the compilers stay loaded.
 *
 * A request is a file `NAME.request` with the arguments of [ProgramCompiler.USAGE], each followed by a NUL. It is deleted when work starts.
 * The answer `NAME.response` contains the exit code on its first line, followed by the messages. Both files are renamed into place.
 * Files are used instead of a connection, because a request survives when the editor reloads its code, and only users with access to the
 * project can create one.
 */
internal class CompileServer(private val folder: Path) {
    /** Waits for requests and compiles them. Never returns. */
    fun run(): Nothing {
        while (true) {
            val request = Files.newDirectoryStream(folder, "*.request").use { it.minOrNull() }
            if (request == null) Thread.sleep(POLL_MS) else answer(request)
        }
    }

    private fun answer(request: Path) {
        val words = request.readText().split('\u0000').dropLast(1)
        request.deleteExisting()
        val messages = ByteArrayOutputStream()
        val code = PrintStream(messages, true, Charsets.UTF_8).use { log ->
            System.setErr(log)
            try {
                ProgramCompiler.compile(words, log)
            } catch (e: Throwable) {
                e.printStackTrace(log)
                CRASHED
            }
        }
        val part = folder.resolve("response.part")
        part.writeBytes("$code\n".encodeToByteArray() + messages.toByteArray())
        Files.move(part, folder.resolve(request.name.replace(".request", ".response")), StandardCopyOption.ATOMIC_MOVE)
    }

    private companion object {
        const val POLL_MS = 20L
        const val CRASHED = 2
    }
}
