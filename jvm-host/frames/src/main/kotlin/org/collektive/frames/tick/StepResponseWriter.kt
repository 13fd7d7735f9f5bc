package org.collektive.frames.tick

import org.collektive.api.Program
import org.collektive.engine.RoundDigest
import org.collektive.engine.Tick
import org.collektive.engine.TickResult
import org.collektive.frame.Inspection
import org.collektive.frame.MessageSizes
import org.collektive.frame.MetricValue
import org.collektive.frame.ReloadResponse
import org.collektive.frame.RoundError
import org.collektive.frame.StateEntry
import org.collektive.frame.StepResponse
import org.collektive.frames.AnswerBuffer
import org.collektive.frames.session.writePrograms
import org.collektive.spi.MessageSize
import org.collektive.spi.StoredValues

/** The outcome of a reload: [error], or empty; the [programs] in use; and [values], or `null` if the reload failed. */
public class ReloadOutcome(internal val error: String, internal val programs: Collection<Program>, internal val values: StoredValues?)

/** A measured value, or NaN and the [error] of the metric. */
public class MetricOutcome(internal val value: Double, internal val error: String?)

/** Writes the `StepResponse` of each tick of a session, with the chained digest. */
public class StepResponseWriter(private val buffer: AnswerBuffer) {
    private val digest = RoundDigest()
    private val size = MessageSize()

    /**
     * Writes [result], whose answers [data] has packed.
     *
     * @param tick its due nodes, and whether to measure their messages.
     * @param metrics those of the session if [tick] measures them, otherwise none.
     * @param inspection of the tick's inspected node, if any.
     * @param begin start of the host call, on the clock of `System.nanoTime()`.
     * @return the position of the response, see [AnswerBuffer.finish].
     */
    public fun write(
        result: TickResult,
        data: UserData,
        tick: Tick,
        begin: Long,
        reload: ReloadOutcome?,
        metrics: List<MetricOutcome>,
        inspection: NodeInspection?,
    ): Long {
        val builder = buffer.builder
        digest.begin(result.tick)
        val actuators = data.answers.write(result, buffer, digest)
        digest.end()
        val errors = if (result.failureCount == 0) 0 else writeErrors(result)
        val reloaded = if (reload == null) 0 else write(reload)
        StepResponse.startNodesVector(builder, result.size - result.failureCount)
        // putInt neither grows nor aligns the buffer, but startNodesVector has done both.
        for (index in result.size - 1 downTo 0) if (result.failure(index) == null) builder.putInt(tick.due[index])
        val nodes = builder.endVector()
        val sizes = if (tick.measuresMessages) writeSizes(result) else 0
        val measured = if (metrics.isEmpty()) 0 else writeMetrics(metrics)
        val inspected = if (inspection == null) 0 else write(inspection)
        StepResponse.startStepResponse(builder)
        StepResponse.addTick(builder, result.tick)
        StepResponse.addDigest(builder, digest.value)
        StepResponse.addNodes(builder, nodes)
        StepResponse.addActuators(builder, actuators)
        if (errors != 0) StepResponse.addErrors(builder, errors)
        if (sizes != 0) StepResponse.addMessages(builder, sizes)
        if (measured != 0) StepResponse.addMetrics(builder, measured)
        if (inspected != 0) StepResponse.addInspection(builder, inspected)
        StepResponse.addNodeCount(builder, result.nodeCount)
        StepResponse.addLinkCount(builder, result.linkCount)
        val network = result.network
        StepResponse.addSent(builder, count(network.sent))
        StepResponse.addDropped(builder, count(network.dropped))
        StepResponse.addDelayed(builder, count(network.delayed))
        StepResponse.addExpired(builder, count(network.expired))
        if (reloaded != 0) StepResponse.addReload(builder, reloaded)
        StepResponse.addRoundMicros(builder, micros(result.roundNanos))
        StepResponse.addHostMicros(builder, micros(System.nanoTime() - begin))
        return buffer.finish(StepResponse.endStepResponse(builder))
    }

    private fun write(reload: ReloadOutcome): Int {
        val builder = buffer.builder
        val error = buffer.text(reload.error)
        val programs = ReloadResponse.createProgramsVector(builder, buffer.writePrograms(reload.programs))
        return ReloadResponse.createReloadResponse(builder, error, programs, reload.values?.stored ?: 0, reload.values?.kept ?: 0)
    }

    private fun write(inspection: NodeInspection): Int {
        val builder = buffer.builder
        val entries = inspection.values.map { (path, value) ->
            StateEntry.createStateEntry(builder, buffer.text(path), buffer.text(value))
        }
        val state = Inspection.createStateVector(builder, entries.toIntArray())
        return Inspection.createInspection(builder, inspection.node, inspection.roundNanos, state)
    }

    private fun writeSizes(result: TickResult): Int {
        val builder = buffer.builder
        StepResponse.startMessagesVector(builder, result.size - result.failureCount)
        for (index in result.size - 1 downTo 0) {
            if (result.failure(index) != null) continue
            size.clear()
            result.export(index)?.measure(size)
            MessageSizes.createMessageSizes(builder, size.values, size.bytes)
        }
        return builder.endVector()
    }

    private fun writeMetrics(metrics: List<MetricOutcome>): Int {
        val builder = buffer.builder
        val tables = metrics.map { MetricValue.createMetricValue(builder, it.value, it.error?.let(buffer::text) ?: 0) }
        return StepResponse.createMetricsVector(builder, tables.toIntArray())
    }

    private fun writeErrors(result: TickResult): Int {
        val builder = buffer.builder
        val errors = (0 until result.size).mapNotNull { index ->
            result.failure(index)?.let { message ->
                val text = buffer.text(message)
                RoundError.createRoundError(builder, result.id(index), builder.createString(result.program(index).name), text)
            }
        }
        return StepResponse.createErrorsVector(builder, errors.toIntArray())
    }

    private fun micros(nanos: Long) = count(nanos / 1000)

    private fun count(value: Long) = value.coerceAtMost(Int.MAX_VALUE.toLong()).toInt()
}
