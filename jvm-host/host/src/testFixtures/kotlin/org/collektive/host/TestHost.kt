package org.collektive.host

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.frame.AggregateRuntime
import org.collektive.frame.Link
import org.collektive.frame.LinkId
import org.collektive.frame.Network
import org.collektive.frame.NodeAdded
import org.collektive.frame.OpenRequest
import org.collektive.frame.OpenResponse
import org.collektive.frame.Parameter
import org.collektive.frame.ReloadRequest
import org.collektive.frame.StepRequest
import org.collektive.frame.StepResponse
import org.collektive.frame.TypeFingerprint
import org.collektive.host.shim.LogLevel
import org.collektive.host.shim.ShimCalls
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.nio.file.Path
import java.util.concurrent.ConcurrentLinkedQueue

/** The shim's functions on a plain JVM: memory, error message, log. */
internal class TestShim : ShimCalls {
    val logs = ConcurrentLinkedQueue<Pair<LogLevel, String>>()
    var error = ""
    var grown: ByteBuffer? = null
    var memoryLeft = Int.MAX_VALUE

    override fun grow(slot: Long, capacity: Int): ByteBuffer? {
        if (capacity > memoryLeft) return null
        return ByteBuffer.allocateDirect(capacity).also { grown = it }
    }

    override fun error(text: String) {
        error = text
    }

    override fun log(level: LogLevel, line: String) {
        logs.add(level to line)
    }
}

/** Builds a tick's request as C# writes it. */
internal class Step(val tick: Long) {
    var time = tick * 0.05
    var deltaTime = 0.05
    var removed = emptyList<Int>()
    var added = emptyList<Added>()
    var unlinked = emptyList<Pair<Int, Int>>()
    var linked = emptyList<Pair<Int, Int>>()
    var due = emptyList<Int>()
    var sensors: List<Sensor>? = null
    var wind: Float? = null
    var reload: Path? = null
    var measuresMessages = false
    var measures = false
    var inspected = -1

    class Added(val id: Int, val program: String? = null, val parameters: Map<String, String> = emptyMap())

    class Sensor(val value: Int, val label: String? = null, val points: Int = 0)

    fun bytes(): ByteBuffer {
        val builder = FlatBufferBuilder(1024)
        val sensorTable = writeSensors(builder, sensors ?: due.map { Sensor(it) })
        val globals = wind?.let {
            builder.startTable(1)
            builder.addFloat(0, it, 0.0)
            builder.endTable()
        } ?: 0
        val nodes = added.map { node ->
            val parameters = node.parameters.map { (name, value) ->
                Parameter.createParameter(builder, builder.createString(name), builder.createString(value))
            }
            val program = node.program?.let(builder::createSharedString) ?: 0
            NodeAdded.createNodeAdded(builder, node.id, program, NodeAdded.createParametersVector(builder, parameters.toIntArray()))
        }
        val addedVector = StepRequest.createNodesAddedVector(builder, nodes.toIntArray())
        val removedVector = StepRequest.createNodesRemovedVector(builder, removed.toIntArray())
        StepRequest.startLinksRemovedVector(builder, unlinked.size)
        unlinked.asReversed().forEach { LinkId.createLinkId(builder, it.first, it.second) }
        val unlinkedVector = builder.endVector()
        StepRequest.startLinksVector(builder, linked.size)
        linked.asReversed().forEach { Link.createLink(builder, it.first, it.second, 1f, 0f) }
        val linkedVector = builder.endVector()
        val dueVector = StepRequest.createDueVector(builder, due.toIntArray())
        val reloadTable = reload?.let {
            ReloadRequest.createReloadRequest(builder, ReloadRequest.createJarsVector(builder, intArrayOf(builder.createString("$it"))))
        } ?: 0
        builder.finish(
            StepRequest.createStepRequest(
                builder, tick, time, deltaTime, removedVector, addedVector, unlinkedVector, linkedVector, dueVector, sensorTable, globals,
                reloadTable,
                measuresMessages,
                measures,
                0,
                inspected,
            ),
        )
        return direct(builder)
    }

    private fun writeSensors(builder: FlatBufferBuilder, sensors: List<Sensor>): Int {
        val tables = sensors.map { sensor ->
            val label = sensor.label?.let { builder.createString(it) } ?: 0
            builder.startVector(12, sensor.points, 4)
            repeat(3 * sensor.points) { builder.addFloat(it.toFloat()) }
            val points = builder.endVector()
            builder.startTable(3)
            builder.addInt(0, sensor.value, 0)
            builder.addOffset(1, label, 0)
            builder.addOffset(2, points, 0)
            builder.endTable()
        }
        val vector = builder.createVectorOfTables(tables.toIntArray())
        builder.startTable(1)
        builder.addOffset(0, vector, 0)
        return builder.endTable()
    }
}

internal fun direct(builder: FlatBufferBuilder): ByteBuffer = direct(builder.sizedByteArray())

internal fun direct(bytes: ByteArray): ByteBuffer = ByteBuffer.allocateDirect(bytes.size).order(ByteOrder.LITTLE_ENDIAN).put(bytes).flip()

/** An `OpenRequest`, as C# would write it. */
internal fun openFrame(
    jars: List<String>,
    program: String = "sum",
    threads: Int = 2,
    schedule: Int = 0,
    protocol: Long = 1,
    schema: String = "probe.ProbeSchema",
    types: Map<String, Long> = ProbeSchema.types,
    network: List<Double>? = null,
    record: String = "",
    runtime: Int = AggregateRuntime.BuiltIn,
    metrics: List<String> = emptyList(),
): ByteBuffer {
    val builder = FlatBufferBuilder(1024)
    val fingerprints = types.map { TypeFingerprint.createTypeFingerprint(builder, builder.createString(it.key), it.value) }
    val networkTable = network?.let { Network.createNetwork(builder, it[0], it[1], it[2], it[3], it[4], it[5], 0.0, 1.0, 1.0) } ?: 0
    val paths = jars.map { builder.createString(it) }
    val metricNames = metrics.map { builder.createString(it) }
    builder.finish(
        OpenRequest.createOpenRequest(
            builder, protocol, 42, threads, schedule, OpenRequest.createJarsVector(builder, paths.toIntArray()),
            builder.createString(schema), OpenRequest.createTypesVector(builder, fingerprints.toIntArray()),
            builder.createString(program), networkTable, builder.createString(record), runtime, 0,
            OpenRequest.createMetricsVector(builder, metricNames.toIntArray()),
        ),
    )
    return direct(builder)
}

/** A session of the real [Host], called as the shim calls it. */
internal class TestSession(private val shim: TestShim, private val id: Long = next++, answerBytes: Int = 1024) {
    private var answer = ByteBuffer.allocateDirect(answerBytes)

    fun open(
        jars: List<String> = listOf(ProbeJars.programs.toString()),
        program: String = "sum",
        threads: Int = 2,
        schedule: Int = 0,
        protocol: Long = 1,
        schema: String = "probe.ProbeSchema",
        types: Map<String, Long> = ProbeSchema.types,
        network: List<Double>? = null,
        record: String = "",
        runtime: Int = AggregateRuntime.BuiltIn,
        metrics: List<String> = emptyList(),
    ): Long = open(openFrame(jars, program, threads, schedule, protocol, schema, types, network, record, runtime, metrics))

    fun open(request: ByteBuffer): Long = call(request) { Host.open(id, request, 0, request.capacity(), 1, answer, 10_000) }

    fun opened(): OpenResponse = OpenResponse.getRootAsOpenResponse(response)

    fun step(request: ByteBuffer, limitMillis: Int = 10_000, offset: Int = 0, length: Int = request.capacity()): Long =
        call(request) { Host.step(id, request, offset, length, 1, answer, limitMillis) }

    /** Runs a step that must succeed, and returns its answer. */
    fun ok(step: Step): StepResponse {
        val code = step(step.bytes())
        check(code >= 0) { "$code: ${shim.error}" }
        return StepResponse.getRootAsStepResponse(response)
    }

    /** Returns value and text of each answer by node id. */
    fun answers(response: StepResponse): Map<Int, Pair<Long, String?>> {
        val table = response.actuators()
        return (0 until response.nodesLength()).associate { response.nodes(it) to ProbeSchema.actuator(table, it) }
    }

    /** Returns value and error of each metric. */
    fun metrics(response: StepResponse): List<Pair<Double, String?>> =
        List(response.metricsLength()) { response.metrics(it).let { metric -> metric.value() to metric.error() } }

    fun errors(response: StepResponse): Map<Int, String> =
        (0 until response.errorsLength()).associate { response.errors(it).node() to response.errors(it).message() }

    fun close() = Host.close(id)

    private lateinit var response: ByteBuffer

    private inline fun call(request: ByteBuffer, work: (ByteBuffer) -> Long): Long {
        Host.shim = shim
        shim.grown = null
        val result = work(request)
        shim.grown?.let { answer = it }
        if (result >= 0) {
            val offset = (result ushr 32).toInt()
            val length = result.toInt()
            response = answer.duplicate().order(ByteOrder.LITTLE_ENDIAN).clear().position(offset).limit(offset + length)
        }
        return result
    }

    private companion object {
        var next = 1L
    }
}
