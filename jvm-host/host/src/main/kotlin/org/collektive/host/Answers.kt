package org.collektive.host

import org.collektive.api.schema.DataSchema
import org.collektive.engine.IntList
import org.collektive.engine.RoundDigest
import org.collektive.engine.TickResult
import java.nio.ByteBuffer
import java.nio.ByteOrder

/** The way of a tick's answers from the rounds into the frame and the digest. */
internal abstract class Answers protected constructor(schema: DataSchema, threads: Int) {
    /** One for each thread that runs rounds. */
    protected val writers = Array(threads) { schema.actuatorWriter() }

    /** Makes room for the answers of [due] nodes. */
    open fun begin(due: Int) = Unit

    /** Takes the [answer] of the due node [index] on the thread [worker]. Why it is of no use, or `null` when it is. */
    open fun take(worker: Int, index: Int, answer: Any): String? = writers[worker].findFault(answer)

    /** Adds the answers of all [due] nodes to [digest] and writes those that there are; the offset of the table `Actuators`. */
    abstract fun write(due: IntList, result: TickResult, buffer: AnswerBuffer, digest: RoundDigest): Int

    companion object {
        fun of(schema: DataSchema, threads: Int): Answers {
            val bytes = schema.actuatorWriter().structBytes
            return if (bytes == 0) TableAnswers(schema, threads) else StructAnswers(schema, threads, bytes)
        }
    }
}

/** Each thread packs the structs of its own rounds, at once, while they are in its processor's cache. They go into the frame as one block. */
private class StructAnswers(schema: DataSchema, threads: Int, private val bytes: Int) : Answers(schema, threads) {
    // Element i is that of the due node i.
    private var packed = ByteBuffer.allocate(0)

    override fun begin(due: Int) {
        val needed = Math.multiplyExact(due, bytes)
        if (packed.capacity() >= needed) return
        packed = ByteBuffer.allocate(maxOf(needed, packed.capacity() + (packed.capacity() shr 1))).order(ByteOrder.LITTLE_ENDIAN)
    }

    override fun take(worker: Int, index: Int, answer: Any): String? {
        val writer = writers[worker]
        writer.findFault(answer)?.let { return it }
        writer.pack(answer, packed.array(), index * bytes)
        return null
    }

    override fun write(due: IntList, result: TickResult, buffer: AnswerBuffer, digest: RoundDigest): Int {
        var count = 0
        for (index in 0 until result.size) {
            if (result.failure(index) != null) {
                digest.failure(due[index])
                continue
            }
            digest.answer(due[index], packed, index * bytes, bytes)
            // Closes the gaps of failed rounds.
            if (count < index) packed.array().copyInto(packed.array(), count * bytes, index * bytes, (index + 1) * bytes)
            count++
        }
        return writers[0].writePacked(buffer.builder, packed, count)
    }
}

/** Tables vary in length, so they are written one after the other when all rounds are over. */
private class TableAnswers(schema: DataSchema, threads: Int) : Answers(schema, threads) {
    // What the writer takes: the answers without gaps, and where their bytes went.
    private var answers = arrayOfNulls<Any?>(0)
    private var ranges = IntArray(0)

    override fun write(due: IntList, result: TickResult, buffer: AnswerBuffer, digest: RoundDigest): Int {
        val count = gather(result)
        val table = writers[0].write(buffer.builder, answers, count, ranges)
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

    /** Puts the answers side by side and returns how many there are. */
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
