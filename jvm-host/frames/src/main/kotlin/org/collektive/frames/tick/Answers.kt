package org.collektive.frames.tick

import org.collektive.engine.IntList
import org.collektive.engine.RoundDigest
import org.collektive.engine.TickResult
import org.collektive.frames.AnswerBuffer
import org.collektive.frames.data.DataSchema
import org.collektive.frames.data.StructWriter
import org.collektive.frames.data.TableWriter
import java.nio.ByteBuffer
import java.nio.ByteOrder

/** Collects the answers of a tick's rounds for the frame and the digest. */
internal abstract class Answers {
    /** Ids of the tick's due nodes. */
    protected var due: IntList = IntList()
        private set

    /** Reserves memory for the answers of [due]. [due] must not change until the next tick. */
    open fun begin(due: IntList) {
        this.due = due
    }

    /** See [org.collektive.engine.RoundData.pack]. */
    abstract fun pack(worker: Int, index: Int, answer: Any): String?

    /** Writes the answers and adds them to [digest], including failed rounds. Returns the offset of the table `Actuators`. */
    abstract fun write(result: TickResult, buffer: AnswerBuffer, digest: RoundDigest): Int

    companion object {
        fun of(schema: DataSchema): Answers = when (val writer = schema.actuatorWriter()) {
            is StructWriter -> StructAnswers(writer)
            is TableWriter -> TableAnswers(writer)
        }
    }
}

/**
 * Answers that are structs. Each thread packs the answers of its rounds twice while they are in its cache: contiguously for the frame, and
 * with headers for the digest. Frame and digest then copy whole blocks.
 */
private class StructAnswers(private val writer: StructWriter) : Answers() {
    private val bytes = writer.bytes
    private val entryBytes = RoundDigest.HEADER_BYTES + bytes

    // Element i of both buffers belongs to due node i.
    private var packed = ByteBuffer.allocate(0)
    private var entries = ByteBuffer.allocate(0)

    override fun begin(due: IntList) {
        super.begin(due)
        packed = withCapacity(packed, due.size, bytes)
        entries = withCapacity(entries, due.size, entryBytes)
    }

    override fun pack(worker: Int, index: Int, answer: Any): String? {
        writer.findProblem(answer)?.let { return it }
        writer.pack(packed, index * bytes, answer)
        val entry = index * entryBytes
        RoundDigest.putHeader(entries, entry, due[index], bytes)
        System.arraycopy(packed.array(), index * bytes, entries.array(), entry + RoundDigest.HEADER_BYTES, bytes)
        return null
    }

    override fun write(result: TickResult, buffer: AnswerBuffer, digest: RoundDigest): Int {
        var count = 0
        var begin = 0
        for (index in 0..result.size) {
            val isEnd = index == result.size
            if (!isEnd && result.failure(index) == null) continue
            digest.answers(entries.array(), begin * entryBytes, index * entryBytes)
            // Closes the gaps of failed rounds.
            if (count < begin) System.arraycopy(packed.array(), begin * bytes, packed.array(), count * bytes, (index - begin) * bytes)
            count += index - begin
            begin = index + 1
            if (!isEnd) digest.failure(due[index])
        }
        return writer.write(buffer.builder, packed, count)
    }

    private fun withCapacity(buffer: ByteBuffer, count: Int, size: Int): ByteBuffer {
        val required = Math.multiplyExact(count, size)
        if (buffer.capacity() >= required) return buffer
        return ByteBuffer.allocate(maxOf(required, buffer.capacity() + (buffer.capacity() shr 1))).order(ByteOrder.LITTLE_ENDIAN)
    }
}

/** Answers that are tables. Their size varies, so they are written one by one after all rounds. */
private class TableAnswers(private val writer: TableWriter) : Answers() {
    // Arguments of TableWriter.write: the answers without failed rounds, and the ranges of their bytes.
    private var answers = arrayOfNulls<Any?>(0)
    private var ranges = IntArray(0)

    override fun pack(worker: Int, index: Int, answer: Any): String? = writer.findProblem(answer)

    override fun write(result: TickResult, buffer: AnswerBuffer, digest: RoundDigest): Int {
        val count = gather(result)
        val table = writer.write(buffer.builder, answers, count, ranges)
        var answered = 0
        for (index in 0 until result.size) {
            if (result.failure(index) != null) {
                digest.failure(due[index])
            } else {
                digest.answer(due[index], buffer.memory, buffer.position(ranges[2 * answered]), ranges[2 * answered + 1])
                answered++
            }
        }
        return table
    }

    /** Copies the answers without gaps and returns their number. */
    private fun gather(result: TickResult): Int {
        if (answers.size < result.size) {
            answers = arrayOfNulls(maxOf(result.size, answers.size + (answers.size shr 1)))
            ranges = IntArray(2 * answers.size)
        }
        var count = 0
        for (index in 0 until result.size) {
            if (result.failure(index) == null) answers[count++] = result.answer(index)
        }
        answers.fill(null, count)
        return count
    }
}
