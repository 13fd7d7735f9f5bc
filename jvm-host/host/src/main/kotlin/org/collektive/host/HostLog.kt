package org.collektive.host

import org.collektive.engine.RoundThread
import java.io.ByteArrayOutputStream
import java.io.OutputStream
import java.io.PrintStream
import java.util.logging.Formatter
import java.util.logging.Handler
import java.util.logging.Level
import java.util.logging.LogManager
import java.util.logging.LogRecord

/** Leads what programs print or log to the shim: line by line, with the node in whose round it happened. */
internal object HostLog {
    fun install(shim: ShimCalls) {
        System.setOut(printStream(shim, LogLevel.INFO))
        System.setErr(printStream(shim, LogLevel.WARNING))
        val root = LogManager.getLogManager().getLogger("")
        root.handlers.forEach(root::removeHandler)
        root.addHandler(ShimHandler(shim))
    }

    fun printStream(shim: ShimCalls, level: LogLevel) = PrintStream(LineStream(shim, level), false, Charsets.UTF_8)

    /** [line] with the node in whose round this thread is. */
    fun inRound(line: String): String {
        val node = (Thread.currentThread() as? RoundThread)?.node ?: -1
        return if (node < 0) line else "[node $node] $line"
    }

    /** Logs each line of [text]. */
    fun lines(shim: ShimCalls, level: LogLevel, text: String) {
        text.lineSequence().filter(String::isNotEmpty).forEach { shim.log(level, inRound(it)) }
    }

    /** Each thread fills a line of its own, so that lines of parallel rounds do not mix. */
    private class LineStream(private val shim: ShimCalls, private val level: LogLevel) : OutputStream() {
        private val lines = ThreadLocal.withInitial { ByteArrayOutputStream() }

        override fun write(byte: Int) {
            val line = lines.get()
            when (byte.toChar()) {
                '\n' -> end(line)
                '\r' -> {}
                else -> {
                    line.write(byte)
                    if (line.size() == MAX_LINE) end(line)
                }
            }
        }

        private fun end(line: ByteArrayOutputStream) {
            shim.log(level, inRound(line.toString(Charsets.UTF_8)))
            line.reset()
        }
    }

    private class ShimHandler(private val shim: ShimCalls) : Handler() {
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
            lines(shim, level, formatter.format(record))
        }

        override fun flush() {}

        override fun close() {}
    }

    private object MessageFormatter : Formatter() {
        override fun format(record: LogRecord): String {
            val message = formatMessage(record)
            val thrown = record.thrown ?: return "${record.loggerName}: $message"
            return "${record.loggerName}: $message\n${thrown.stackTraceToString()}"
        }
    }

    private const val MAX_LINE = 4096
}
