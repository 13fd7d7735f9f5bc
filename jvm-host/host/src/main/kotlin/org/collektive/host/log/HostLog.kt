package org.collektive.host.log

import org.collektive.engine.RoundThread
import org.collektive.host.shim.LogLevel
import org.collektive.host.shim.ShimCalls
import java.io.ByteArrayOutputStream
import java.io.OutputStream
import java.io.PrintStream
import java.util.logging.Formatter
import java.util.logging.Handler
import java.util.logging.Level
import java.util.logging.LogManager
import java.util.logging.LogRecord

/**
 * Sends the output and log messages of programs to the shim, prefixed with the node and the program.
 *
 * This includes slf4j, whose binding to `java.util.logging` is on the host's class path.
 */
public class HostLog(private val shim: ShimCalls) {
    private val out = ShimStream(LogLevel.INFO)
    private val err = ShimStream(LogLevel.WARNING)
    private val handler = ShimHandler()
    private val failures = ThreadFailures(shim)

    /** Redirects standard output, `java.util.logging` and uncaught exceptions. Call it again to undo redirections by a program. */
    public fun install() {
        System.setOut(out)
        System.setErr(err)
        val root = LogManager.getLogManager().getLogger("")
        root.handlers.forEach(root::removeHandler)
        root.addHandler(handler)
        if (root.level == null) root.level = Level.INFO
        Thread.setDefaultUncaughtExceptionHandler(failures)
    }

    /** Logs the counts of repeated uncaught exceptions. */
    public fun logCounts() {
        failures.logCounts()
    }

    /** A stream that ignores `close`, because all programs share it. */
    private inner class ShimStream(level: LogLevel) : PrintStream(LineStream(level), false, Charsets.UTF_8) {
        override fun close() = flush()
    }

    /** Buffers one line per thread, so that the lines of parallel rounds do not mix. Splits long lines between characters. */
    private inner class LineStream(private val level: LogLevel) : OutputStream() {
        private val lines = ThreadLocal.withInitial { ByteArrayOutputStream() }

        override fun write(bytes: ByteArray, offset: Int, length: Int) {
            val line = lines.get()
            var begin = offset
            for (at in offset until offset + length) {
                val hasRoom = line.size() + at - begin + MAX_CHARACTER <= MAX_LINE
                if (hasRoom && bytes[at].toInt() != '\n'.code && bytes[at].toInt() != '\r'.code) continue
                line.write(bytes, begin, at - begin)
                begin = at
                write(bytes[begin++].toInt())
            }
            line.write(bytes, begin, offset + length - begin)
        }

        override fun write(byte: Int) {
            val line = lines.get()
            when (byte.toChar()) {
                '\n' -> end(line)

                '\r' -> {}

                else -> {
                    if (line.size() + bytesOfCharacter(byte) > MAX_LINE) end(line)
                    line.write(byte)
                }
            }
        }

        /** Returns the length of the UTF-8 character that starts with [byte]; 1 for other bytes. */
        private fun bytesOfCharacter(byte: Int): Int = when (byte and 0xFF) {
            in 0xC0..0xDF -> 2
            in 0xE0..0xEF -> 3
            in 0xF0..0xFF -> MAX_CHARACTER
            else -> 1
        }

        override fun flush() {
            val line = lines.get()
            if (line.size() > 0) end(line)
        }

        private fun end(line: ByteArrayOutputStream) {
            shim.log(level, attributed(line.toString(Charsets.UTF_8)))
            line.reset()
        }
    }

    private inner class ShimHandler : Handler() {
        init {
            formatter = MessageFormatter
        }

        override fun publish(record: LogRecord) {
            if (!isLoggable(record)) return
            val level = when {
                record.level.intValue() >= Level.SEVERE.intValue() -> LogLevel.ERROR
                record.level.intValue() >= Level.WARNING.intValue() -> LogLevel.WARNING
                record.level.intValue() >= Level.INFO.intValue() -> LogLevel.INFO
                else -> LogLevel.DEBUG
            }
            shim.log(level, attributed(formatter.format(record)))
        }

        override fun flush() {}

        override fun close() {}
    }

    private object MessageFormatter : Formatter() {
        override fun format(record: LogRecord): String {
            val message = formatMessage(record)
            val thrown = record.thrown ?: return "${record.loggerName}: $message"
            return "${record.loggerName}: $message\n${thrown.stackTraceToString().trimEnd()}"
        }
    }

    internal companion object {
        // Both are in bytes of UTF-8.
        private const val MAX_LINE = 4096
        private const val MAX_CHARACTER = 4

        /** Returns [text], prefixed with the node and the program if this thread runs their code. */
        fun attributed(text: String): String = RoundThread.origin()?.let { "[$it] $text" } ?: text
    }
}
