package org.collektive.bench.rounds

import org.openjdk.jmh.profile.GCProfiler
import org.openjdk.jmh.results.RunResult
import org.openjdk.jmh.runner.Runner
import org.openjdk.jmh.runner.options.Options
import org.openjdk.jmh.runner.options.OptionsBuilder
import org.openjdk.jmh.runner.options.TimeValue
import org.openjdk.jmh.runner.options.VerboseMode
import java.io.File
import java.util.Locale

/**
 * `./collektive bench rounds [--quick]`: measures all programs on both topologies, prints a table and writes the JSON file that the
 * first argument names.
 */
public fun main(arguments: Array<String>) {
    val measurement = Measurement(isQuick = "--quick" in arguments)
    val rows = measurement.rows()
    File(arguments[0]).writeText(rows.joinToString(",\n  ", "[\n  ", "\n]\n", transform = RoundsRow::json))
    println(RoundsRow.HEADER)
    rows.forEach { println(it.line) }
}

/** The cost of one round: time, allocated bytes, and the ratio to hand-written loops in the same run; `null` without such loops. */
private class RoundsRow(
    private val program: String,
    private val topology: String,
    private val nodes: Int,
    private val micros: Double,
    private val bytes: Double,
    private val ratio: Double?,
) {
    val json: String
        get() = """{"program": "$program", "topology": "$topology", "nodes": $nodes, "us_per_round": ${"%.4f".text(micros)}, """ +
            """"bytes_per_round": ${"%.0f".text(bytes)}, "ratio_to_handwritten": ${ratio?.let { "%.2f".text(it) }}}"""

    val line: String
        get() = "%-8s %-9s %6d %13.3f %12.0f %21s".text(program, topology, nodes, micros, bytes, ratio?.let { "%.1f".text(it) } ?: "")

    companion object {
        private fun String.text(vararg values: Any): String = format(Locale.ROOT, *values)

        const val HEADER = "program  topology   nodes  us per round  bytes/round  ratio to handwritten"
    }
}

private class Measurement(private val isQuick: Boolean) {
    private val cases = TOPOLOGIES.flatMap { topology ->
        PROGRAMS.map { Triple(it, topology, DEFAULT_SIZE) } +
            HANDWRITTEN.flatMap { program -> (if (isQuick) ENDS else SIZES).map { Triple(program, topology, it) } }
    }

    fun rows(): List<RoundsRow> = cases.mapIndexed { index, (program, topology, nodes) ->
        System.err.println("[${index + 1}/${cases.size}] $program on $topology, $nodes nodes")
        val engine = run("engine", program, topology, nodes)
        val byHand = if (program in HANDWRITTEN) run("handwritten", program, topology, nodes).micros else null
        val micros = engine.micros / nodes
        RoundsRow(program, topology, nodes, micros, engine.bytes / nodes, byHand?.let { engine.micros / it })
    }

    private fun run(benchmark: String, program: String, topology: String, nodes: Int): RunResult =
        Runner(options(benchmark, program, topology, nodes)).runSingle()

    private fun options(benchmark: String, program: String, topology: String, nodes: Int): Options = OptionsBuilder()
        .include("RoundsBenchmark.$benchmark$")
        .param("program", program).param("topology", topology).param("nodes", "$nodes")
        .forks(1).threads(1)
        .warmupIterations(if (isQuick) 3 else 5).warmupTime(TimeValue.milliseconds(if (isQuick) 500 else 1000))
        .measurementIterations(5).measurementTime(TimeValue.milliseconds(if (isQuick) 300 else 1000))
        // Huge pages if available: with small ones, TLB misses dominate large networks.
        .jvmArgsAppend("-XX:+UseSerialGC", "-Xms2g", "-Xmx2g", "-XX:+AlwaysPreTouch", "-XX:+UseTransparentHugePages")
        .addProfiler(GCProfiler::class.java)
        .shouldFailOnError(true)
        .verbosity(VerboseMode.SILENT)
        .build()

    private val RunResult.micros get() = primaryResult.score
    private val RunResult.bytes get() = checkNotNull(secondaryResults["gc.alloc.rate.norm"]) { "JMH measured no allocation" }.score

    private companion object {
        val TOPOLOGIES = listOf("grid8", "rgg10")
        val PROGRAMS = listOf("a", "b", "b2", "c")
        val HANDWRITTEN = listOf("a", "b2")
        const val DEFAULT_SIZE = 1000
        val SIZES = listOf(500, 5_000, 50_000)
        val ENDS = listOf(500, 50_000)
    }
}
