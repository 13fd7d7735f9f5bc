package org.collektive.tools.profile

import jdk.jfr.consumer.RecordedEvent
import jdk.jfr.consumer.RecordedFrame
import jdk.jfr.consumer.RecordingFile
import org.collektive.host.jfr.RoundSampling
import java.io.IOException
import java.nio.file.Path
import java.time.Duration
import java.util.Locale
import kotlin.system.exitProcess

/**
 * Summarises a flight recording as text: tick times, hot methods per program, allocations and garbage collection pauses.
 *
 * A sample belongs to the outermost program on its stack; `collektive.ProgramRound` events contain the function of each program.
 */
internal class ProfileReport {
    private val ticks = ArrayList<RecordedEvent>()
    private val programs = sortedMapOf<String, Program>()
    private val samples = ArrayList<RecordedEvent>()
    private val allocations = Counter()
    private val pauses = ArrayList<Duration>()
    private var errors = 0L

    /** Adds the events of a recording. Throws an [IOException] if the file is truncated or damaged. */
    fun read(file: Path): ProfileReport {
        try {
            RecordingFile(file).use { while (it.hasMoreEvents()) add(it.readEvent()) }
        } catch (e: RuntimeException) {
            // The parser does not check the offsets and sizes in a file.
            throw IOException("damaged: $e", e)
        }
        return this
    }

    private fun add(event: RecordedEvent) {
        when (event.eventType.name) {
            "collektive.Tick" -> ticks += event

            "collektive.ProgramRound" -> {
                val program = programs.getOrPut(event.getString("program")) { Program(event.getString("function")) }
                program.rounds += event.duration
                program.exports += event.getInt("exports")
            }

            "collektive.ProgramError" -> errors++

            "jdk.ExecutionSample" -> samples += event

            "jdk.ObjectAllocationSample" -> allocations.add(event.getClass("objectClass").name.readable(), event.getLong("weight"))

            "jdk.GCPhasePause" -> pauses += event.duration
        }
    }

    fun text(): String = buildString {
        writeTicks()
        if (samples.isEmpty()) append("\nno samples: the recording is too short, or its settings disable samples\n")
        writePrograms()
        writeAllocations()
        writePauses()
    }

    private fun StringBuilder.writeTicks() {
        if (ticks.isEmpty()) {
            append("no ticks: no simulation ran during the recording\n")
            return
        }
        val last = ticks.maxBy { it.getLong("tick") }
        line("%d ticks of %d nodes and %d links; %d rounds failed", ticks.size, last.getInt("nodes"), last.getInt("links"), errors)
        line("  %-22s %10s %10s", "", "median", "p99")
        phase("tick on the JVM", ticks.map { it.duration })
        phase("  rounds", ticks.map { it.getDuration("rounds") })
        phase("  answer", ticks.map { it.getDuration("write") })
        phase("between ticks", ticks.map { it.getDuration("wait") })
        val (bytesIn, bytesOut) = listOf("bytesIn", "bytesOut").map { name -> ticks.map { it.getLong(name) / KILO }.median() }
        line("  %-22s %7.1f kB %7.1f kB", "frame in, out (median)", bytesIn, bytesOut)
    }

    private fun StringBuilder.phase(name: String, times: List<Duration>) {
        val millis = times.map { it.toNanos() / NANOS_PER_MILLI }
        line("  %-22s %7.3f ms %7.3f ms", name, millis.median(), millis.percentile(99))
    }

    private fun StringBuilder.writePrograms() {
        val others = Counter()
        for (sample in samples) {
            val frames = sample.stackTrace?.frames.orEmpty().filter(RecordedFrame::isJavaFrame)
            if (frames.isEmpty()) continue
            val owner = frames.asReversed().firstNotNullOfOrNull { frame -> programs.values.firstOrNull { it.function == frame.place() } }
            (owner?.methods ?: others).add(frames.first().place(), 1, frames.first().lineNumber)
        }
        for ((name, program) in programs) {
            val rounds = program.rounds.map { it.toNanos() / NANOS_PER_MICRO }
            line("\nprogram %s (%s)", name, program.function)
            line(
                "  %d rounds sampled (one in %d): %.1f us median, %.1f us p99, %.1f exports per round",
                rounds.size,
                RoundSampling.INTERVAL,
                rounds.median(),
                rounds.percentile(99),
                program.exports.toDouble() / rounds.size,
            )
            writeTop(program.methods, "of %d samples")
        }
        line("\noutside programs")
        writeTop(others, "of %d samples")
    }

    private fun StringBuilder.writeAllocations() {
        line("\nallocated, estimated from samples: %.1f MB", allocations.total / MEGA)
        writeTop(allocations, "of all bytes")
    }

    private fun StringBuilder.writePauses() {
        val sorted = pauses.map { it.toNanos() / NANOS_PER_MILLI }.sorted()
        if (sorted.isEmpty()) {
            line("\nno garbage collection pauses")
        } else {
            line("\n%d garbage collection pauses: %.2f ms in total, %.2f ms maximum", sorted.size, sorted.sum(), sorted.last())
        }
    }

    private fun StringBuilder.writeTop(counter: Counter, of: String) {
        for ((name, count) in counter.top()) line("  %5.1f %%  %s", 100.0 * count / counter.total, name)
        if (counter.total > 0) line("  $of", counter.total)
    }

    private fun StringBuilder.line(format: String, vararg values: Any) {
        append(format.format(Locale.ROOT, *values)).append('\n')
    }

    private class Program(val function: String) {
        val rounds = ArrayList<Duration>()
        val methods = Counter()
        var exports = 0L
    }

    private class Counter {
        private val counts = HashMap<String, Long>()
        private val lines = HashMap<String, HashMap<Int, Long>>()
        var total = 0L
            private set

        fun add(name: String, count: Long, line: Int = 0) {
            counts.merge(name, count, Long::plus)
            if (line > 0) lines.getOrPut(name, ::HashMap).merge(line, count, Long::plus)
            total += count
        }

        /** Returns the names with the largest counts, each followed by its line with the largest count. */
        fun top(): List<Pair<String, Long>> = counts.entries.sortedWith(
            compareByDescending<Map.Entry<String, Long>> {
                it.value
            }.thenBy { it.key },
        ).take(TOP).map { (name, count) ->
            val line = lines[name]?.entries?.maxWith(compareBy<Map.Entry<Int, Long>> { it.value }.thenByDescending { it.key })?.key
            (if (line == null) name else "$name:$line") to count
        }
    }

    internal companion object {
        private const val TOP = 8
        private const val KILO = 1e3
        private const val MEGA = 1e6
        private const val NANOS_PER_MILLI = 1e6
        private const val NANOS_PER_MICRO = 1e3

        private fun RecordedFrame.place() = "${method.type.name}.${method.name}"

        private fun List<Double>.median(): Double = percentile(50)

        /** Returns a percentile by the nearest-rank method, as in manifests. */
        private fun List<Double>.percentile(percent: Int): Double = if (isEmpty()) 0.0 else sorted()[(size * percent + 99) / 100 - 1]

        /** Converts the class name "[J" to "long[]". */
        private fun String.readable(): String {
            val dimensions = takeWhile { it == '[' }.length
            if (dimensions == 0) return this
            val element = when (val code = this[dimensions]) {
                'L' -> substring(dimensions + 1).removeSuffix(";")
                else -> PRIMITIVES[code] ?: return this
            }
            return element + "[]".repeat(dimensions)
        }

        private val PRIMITIVES = mapOf(
            'Z' to "boolean",
            'B' to "byte",
            'C' to "char",
            'S' to "short",
            'I' to "int",
            'J' to "long",
            'F' to "float",
            'D' to "double",
        )

        /** Prints the report of the recording whose path is the only argument. */
        @JvmStatic
        fun main(arguments: Array<String>) {
            val file = Path.of(arguments.single())
            try {
                print(ProfileReport().read(file).text())
            } catch (e: IOException) {
                System.err.println("collektive: cannot read the flight recording '$file' (${e.message}): profile the scenario again")
                exitProcess(1)
            }
        }
    }
}
