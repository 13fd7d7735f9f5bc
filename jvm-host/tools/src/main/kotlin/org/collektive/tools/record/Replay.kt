package org.collektive.tools.record

import org.collektive.frame.OpenRequestT
import org.collektive.frames.session.openFrame
import org.collektive.frames.session.openRequest
import org.collektive.frames.tick.StepResponseReader
import org.collektive.host.library.AggregateRuntime
import org.collektive.host.log.HostLog
import org.collektive.host.programs.JarBytes
import org.collektive.host.record.RecordWriter
import org.collektive.host.session.Session
import org.collektive.host.session.SessionOpening
import org.collektive.host.shim.HostException
import org.collektive.host.shim.LogLevel
import org.collektive.host.shim.ShimCalls
import java.io.IOException
import java.io.PrintStream
import java.nio.ByteBuffer
import java.util.concurrent.TimeUnit

/**
 * Runs the programs of a record, or other programs, on the recorded requests, and compares the answers with the recorded ones.
 *
 * @property request the settings of the session.
 * @property programs the jars of its programs.
 * @property reloaded returns the jars that a step with a reload loads.
 * @property out the file that records the replay; `null` to record nothing.
 */
internal class Replay(
    private val record: Record,
    private val request: OpenRequestT,
    private val programs: List<JarBytes>,
    private val reloaded: (RecordedStep) -> List<JarBytes>,
    private val out: String?,
    private val report: Report,
) : ShimCalls {
    private var current: RecordedStep? = null
    private var answer: ByteBuffer = ByteBuffer.allocate(FIRST_ANSWER_BYTES)
    private var ticks = 0L
    private var failedRounds = 0L
    private var recordedFailedRounds = 0L

    private val types by lazy { RecordedTypes.of(record.settings.schema(), programs) }

    /** Runs all steps of the record. Returns whether every answer equals the recorded one. */
    fun run(): Boolean {
        val frame = openFrame(request)
        val readJars = { _: List<String> -> reloaded(checkNotNull(current)) }
        var writer: RecordWriter? = null
        val session = SessionOpening.open(openRequest(frame), programs, this, readJars) {
            out?.let { RecordWriter.create(it, frame, programs) }.also { writer = it }
        }
        val out = System.out
        val err = System.err
        HostLog(this).install()
        val isEqual = try {
            run(session)
        } finally {
            session.close()
            System.setOut(out)
            System.setErr(err)
        }
        if (writer?.isComplete == false) throw InvalidRecordException("the record of the replay is incomplete; the reason is above")
        return isEqual
    }

    private fun run(session: Session): Boolean {
        var isEqual = true
        var digest = 0L
        try {
            while (true) {
                val step = record.next() ?: break
                val now = step(session, step)
                if (isEqual) {
                    val difference = difference(step, now)
                    if (difference != null) {
                        isEqual = false
                        report.line("tick ${ticks + 1} is the first difference. $difference")
                    }
                }
                if (now is StepResponseReader) {
                    ticks++
                    digest = now.response.digest()
                    failedRounds += now.response.errorsLength()
                    recordedFailedRounds += step.answer?.response?.errorsLength() ?: 0
                }
                report.progress("replay", record)
                if (!isEqual && (now is StepResponseReader) != (step.answer != null)) break
            }
        } finally {
            val verdict = if (isEqual) "all digests equal the record" else "with differences"
            report.line(
                "$ticks ticks replayed, $verdict; the last digest is ${hex(digest)} (${AggregateRuntime.of(request.runtime).title})",
            )
            if (failedRounds + recordedFailedRounds > 0) report.line("$failedRounds rounds failed ($recordedFailedRounds in the record)")
        }
        return isEqual
    }

    /** Runs [step]. Returns the answer, or the error message as a [String]. Throws [HostException] if [out] cannot be written. */
    private fun step(session: Session, step: RecordedStep): Any {
        val begin = System.nanoTime()
        current = step
        return try {
            val written = session.step(step.request, 0, answer, begin, LIMIT_NANOS)
            val offset = (written ushr Int.SIZE_BITS).toInt()
            StepResponseReader(answer.duplicate().order(answer.order()).clear().position(offset).limit(offset + written.toInt()))
        } catch (e: HostException) {
            if (out != null && e.cause is IOException) throw e
            e.message.orEmpty()
        }
    }

    private fun difference(step: RecordedStep, now: Any): String? {
        val then = step.answer
        return when {
            then == null -> if (now is StepResponseReader) "It failed in the record (${step.failure}) but not in the replay" else null

            now !is StepResponseReader -> "It failed in the replay but not in the record: $now"

            then.response.digest() == now.response.digest() -> null

            else -> "Digest ${hex(then.response.digest())} in the record, ${hex(now.response.digest())} in the replay. " +
                (Difference.ofAnswers(types, then, now)?.line("the record" to "the replay") ?: "All fields of its answers are equal")
        }
    }

    override fun grow(slot: Long, capacity: Int): ByteBuffer = ByteBuffer.allocate(capacity).also { answer = it }

    override fun error(text: String) = Unit

    override fun log(level: LogLevel, line: String) = report.log(line)

    private companion object {
        const val FIRST_ANSWER_BYTES = 1 shl 16
        val LIMIT_NANOS = TimeUnit.SECONDS.toNanos(60)
    }
}

/** Formats a digest as manifests do: 16 hexadecimal digits. */
internal fun hex(digest: Long): String = digest.toULong().toString(16).padStart(16, '0')

/** Returns a line in which escape sequences of a record cannot reach the terminal. */
internal fun printable(line: String): String = String(CharArray(line.length) { if (line[it].isISOControl()) '?' else line[it] })

/** Prints results and progress to separate streams. */
internal class Report(private val results: PrintStream, private val messages: PrintStream) {
    private var shown = 0L

    fun line(text: String) = results.println(printable(text))

    fun log(text: String) = messages.println(text)

    /** Prints how much of [record] has been read, at most twice a second. */
    fun progress(what: String, record: Record) {
        val now = System.nanoTime()
        if (shown == 0L) shown = now
        if (now - shown < INTERVAL_NANOS) return
        shown = now
        val (done, all) = record.progress
        messages.println("$what: ${100 * done / all} %, tick ${record.tick}")
    }

    private companion object {
        val INTERVAL_NANOS = TimeUnit.MILLISECONDS.toNanos(500)
    }
}
