package org.collektive.host.session

import org.collektive.engine.Engine
import org.collektive.engine.InvalidTickException
import org.collektive.engine.Reload
import org.collektive.engine.RoundTimeoutException
import org.collektive.engine.Tick
import org.collektive.engine.TickResult
import org.collektive.frames.AnswerBuffer
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.data.DataSchema
import org.collektive.frames.session.writeOpenResponse
import org.collektive.frames.tick.MetricOutcome
import org.collektive.frames.tick.NodeInspection
import org.collektive.frames.tick.ReloadOutcome
import org.collektive.frames.tick.StepResponseWriter
import org.collektive.host.record.RecordWriter
import org.collektive.host.shim.Debugger
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import org.collektive.host.shim.LogLevel
import org.collektive.host.shim.ShimCalls
import java.io.IOException
import java.nio.ByteBuffer
import java.util.concurrent.TimeUnit

/** One simulation: reads its frames, runs them on its engine and writes the answers. Not thread-safe. */
public class Session internal constructor(
    private var loaded: LoadedPrograms,
    private val reload: ProgramReload,
    private val engine: Engine,
    private val shim: ShimCalls,
    private val record: RecordWriter?,
) : AutoCloseable {
    private val buffer = AnswerBuffer(ShimSlots(shim))
    private val response = StepResponseWriter(buffer)
    private val events = TickEvents()
    private var failure: String? = null

    /** The schema of the user data. */
    public val schema: DataSchema get() = loaded.programs.schema

    /** Writes the `OpenResponse` to [answer], the current buffer of [slot]. Returns its position, `offset << 32 | length`. */
    internal fun answerOpen(slot: Long, answer: ByteBuffer): Long {
        buffer.begin(slot, answer)
        return buffer.writeOpenResponse(loaded.programs.infos)
    }

    /**
     * Runs the tick of the `StepRequest` between position and limit of [frame], and writes the `StepResponse` to [answer], the current
     * buffer of [slot].
     *
     * @param begin start of the host call, on the clock of `System.nanoTime()`.
     * @param limit time limit of the rounds in nanoseconds; it excludes the time while a debugger is attached.
     * @return the position of the response, `offset << 32 | length`.
     * @throws HostException when the frame is rejected and nothing has changed, or when the session fails and must be closed.
     */
    public fun step(frame: ByteBuffer, slot: Long, answer: ByteBuffer, begin: Long, limit: Long): Long {
        failure?.let { throw HostException(HostError.SESSION_FAILED, it) }
        if (record == null) return run(frame, slot, answer, begin, limit)
        recording { step(frame) }
        val written = try {
            run(frame, slot, answer, begin, limit)
        } catch (e: Throwable) {
            recording { failed(e.message ?: e.toString()) }
            throw e
        }
        val offset = (written ushr Int.SIZE_BITS).toInt()
        recording { done(buffer.memory.limit(offset + written.toInt()).position(offset)) }
        return written
    }

    private fun run(frame: ByteBuffer, slot: Long, answer: ByteBuffer, begin: Long, limit: Long): Long {
        events.begin(begin)
        engine.wake()
        reading { loaded.requests.check(frame) }
        val prepared = loaded.requests.reloadedJars?.let { prepare(it, frame) }
        val next = prepared?.loaded ?: loaded
        val tick = reading { next.requests.read() }
        tick.reload = prepared?.change
        val deadline = Debugger.asLong + limit
        val result = failing(tick, limit) { engine.step(tick, next.data, deadline) }
        next.data.accept(tick)
        loaded = next
        val metrics = if (tick.measures) failing(tick, limit) { measure(tick, deadline) } else emptyList()
        val inspection = if (tick.inspected >= 0) failing(tick, limit) { inspect(deadline) } else null
        val outcome = prepared?.let { ReloadOutcome(it.error, next.programs.infos, result.storedValues) }
        val place = write(result, tick, outcome, metrics, inspection, slot, answer, begin)
        events.end(result, frame.remaining(), place.toInt())
        return place
    }

    private fun prepare(paths: List<String>, frame: ByteBuffer): PreparedReload {
        val jars = try {
            reload.readJars(paths)
        } catch (e: HostException) {
            return PreparedReload(loaded, null, e.message.orEmpty())
        }
        recording { jars(jars) }
        val prepared = reload.prepare(jars, loaded)
        return try {
            reading {
                prepared.loaded.requests.check(frame)
                prepared.loaded.requests.read()
            }
            prepared
        } catch (e: HostException) {
            // The new programs reject a node of this tick. If the previous ones also reject it, reading the frame again fails.
            PreparedReload(loaded, null, e.message.orEmpty())
        }
    }

    private fun measure(tick: Tick, deadline: Long): List<MetricOutcome> {
        var metrics = emptyList<MetricOutcome>()
        engine.run(deadline, "metrics") {
            val network = engine.snapshot(tick, loaded.data::snapshot)
            metrics = loaded.programs.metrics.map { it.measure(network) }
        }
        return metrics
    }

    /** Runs on a round thread, because texts of values call users' code. */
    private fun inspect(deadline: Long): NodeInspection? {
        var inspection: NodeInspection? = null
        engine.run(deadline, "the inspection") { inspection = engine.inspect(NodeInspection.MAX_VALUES)?.let(::NodeInspection) }
        return inspection
    }

    private inline fun <T> failing(tick: Tick, limit: Long, work: () -> T): T = try {
        work()
    } catch (e: InvalidTickException) {
        throw HostException(HostError.FRAME, e.message.orEmpty(), e)
    } catch (e: RoundTimeoutException) {
        shim.log(LogLevel.ERROR, "${e.message}; stack traces of its threads:")
        e.threads.lineSequence().filter(String::isNotEmpty).forEach { shim.log(LogLevel.ERROR, it) }
        throw fail(e) {
            val millis = TimeUnit.NANOSECONDS.toMillis(limit)
            "${e.message} of $millis ms (stepLimitMs); the log shows what each thread was doing. Fix the program or raise the limit, " +
                "then start the simulation again"
        }
    } catch (e: Throwable) {
        throw fail(e) { "tick ${tick.number} failed with an internal error: $e" }
    }

    private fun write(
        result: TickResult,
        tick: Tick,
        reload: ReloadOutcome?,
        metrics: List<MetricOutcome>,
        inspection: NodeInspection?,
        slot: Long,
        answer: ByteBuffer,
        begin: Long,
    ): Long = try {
        events.write()
        buffer.begin(slot, answer)
        response.write(result, loaded.data, tick, begin, reload, metrics, inspection)
    } catch (e: Throwable) {
        throw fail(e) { "cannot write the answer of tick ${result.tick}: $e" }
    }

    override fun close() {
        engine.close()
        events.close(engine.lastTick, failure)
        if (record == null) return
        try {
            record.use(RecordWriter::end)
        } catch (e: IOException) {
            shim.log(LogLevel.ERROR, record.failure(e))
        }
    }

    private inline fun recording(write: RecordWriter.() -> Unit) {
        val record = record ?: return
        try {
            record.write()
        } catch (e: IOException) {
            throw fail(e) { record.failure(e) }
        }
    }

    /** Marks the session as failed. Sets a constant first, because [text] may throw if the heap is exhausted. */
    private inline fun fail(cause: Throwable, text: () -> String): HostException {
        failure = "out of memory in an earlier tick; raise the maximum heap in the JVM settings (jvm.maximumHeapMb)"
        engine.close()
        val why = text()
        failure = why
        return HostException(HostError.SESSION_FAILED, why, cause)
    }
}

/** Runs [work] on this resource, and closes the resource if it fails. */
internal inline fun <R : AutoCloseable?, T> R.orClose(work: (R) -> T): T = try {
    work(this)
} catch (e: Throwable) {
    this?.close()
    throw e
}

/** Runs [read] and converts a [MalformedFrameException] to a [HostException]. */
internal inline fun <T> reading(read: () -> T): T = try {
    read()
} catch (e: MalformedFrameException) {
    val frame = if (e.tick == null) "the frame" else "the frame of tick ${e.tick}"
    throw HostException(HostError.FRAME, "$frame is damaged: ${e.message}", e)
}
