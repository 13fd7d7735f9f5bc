package org.collektive.host.fuzz

import org.collektive.frame.FrameLayouts
import org.collektive.frame.StepRequest
import org.collektive.frame.StepResponse
import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.frameIn
import org.collektive.host.Step
import org.collektive.host.TestSession
import org.collektive.host.TestShim
import org.collektive.host.direct
import org.collektive.host.openFrame
import org.collektive.host.shim.HostError
import java.nio.ByteBuffer

/**
 * Sends arbitrary bytes as the `StepRequest` of the second tick of a small network, which must either run, or be rejected and change
 * nothing.
 *
 * Two sessions receive the accepted frames, but only one of them receives the rejected frames. Both must stay equal. Later inputs use the
 * same sessions, because opening one takes a hundred times as long as a tick. For this, the tick number of each frame is set to the
 * sessions' next tick.
 */
internal object StepFuzzer : Fuzzer {
    private val shim = TestShim()
    private val refusals = setOf(HostError.FRAME, HostError.PROGRAM)
    private var pair: SessionPair? = null

    /** Compiles the programs. Jazzer calls this before the first input, without a time limit. */
    @JvmStatic
    fun fuzzerInitialize() = FuzzedPrograms.place()

    /** Tests an input. Jazzer calls this for each one. */
    @JvmStatic
    fun fuzzerTestOneInput(bytes: ByteArray) {
        run(bytes)
    }

    override fun run(bytes: ByteArray): Boolean {
        FuzzedPrograms.place()
        val twins = pair ?: SessionPair()
        // After a contract violation, the next input starts with new sessions.
        pair = null
        val accepted = twins.run(bytes)
        pair = twins
        return accepted
    }

    private class SessionPair {
        private val fuzzed = opened()
        private val reference = opened()
        private var tick = 1L
        private var nodes = FuzzSeeds.firstTick().added.map(Step.Added::id)

        init {
            same { FuzzSeeds.firstTick() }
        }

        fun run(bytes: ByteArray): Boolean {
            val frame = ofTick(tick, bytes)
            val code = fuzzed.step(direct(frame))
            requireRefusal(code, refusals, shim)
            if (code < 0) {
                same { Step(tick).apply { due = nodes } }
                return false
            }
            check(reference.step(direct(frame)) >= 0) { "one session accepted the frame, the other rejected it: ${shim.error}" }
            tick++
            val request = StepRequest.getRootAsStepRequest(ByteBuffer.wrap(frame))
            val gone = (0 until request.nodesRemovedLength()).map(request::nodesRemoved).toSet()
            nodes = (nodes - gone + (0 until request.nodesAddedLength()).map { request.nodesAdded(it).id() }).sorted()
            same { Step(tick).apply { due = nodes } }
            restart()
            return true
        }

        private fun restart() {
            val present = nodes
            nodes = FuzzSeeds.firstTick().added.map(Step.Added::id)
            same { FuzzSeeds.firstTick(tick).apply { removed = present } }
        }

        /** Runs [step] in both sessions and requires equal answers. */
        private fun same(step: () -> Step) {
            check(outcome(fuzzed.ok(step())) == outcome(reference.ok(step()))) { "the sessions differ after: ${shim.error}" }
            tick++
        }

        private fun outcome(answer: StepResponse) = listOf(
            answer.digest(),
            answer.nodeCount().toLong(),
            answer.linkCount().toLong(),
            answer.sent().toLong(),
            answer.errorsLength().toLong(),
        )

        private fun opened() = TestSession(shim).also {
            check(it.open(openFrame(listOf(FuzzedPrograms.PATH), threads = 1)) >= 0) { shim.error }
        }
    }

    /** Returns [bytes]. If they are a frame of tick 2, sets its tick number to [tick]. */
    private fun ofTick(tick: Long, bytes: ByteArray): ByteArray {
        val copy = bytes.copyOf()
        try {
            val frame = frameIn(ByteBuffer.wrap(copy), 0, copy.size)
            val table = FrameChecker(FramePolicy.FRAME).checkRoot(frame, FrameLayouts.STEP_REQUEST)
            val vtable = table - frame.getInt(table)
            val place = if (frame.getShort(vtable) > FIRST_FIELD) frame.getShort(vtable + FIRST_FIELD).toInt() else 0
            if (place != 0 && frame.getLong(table + place) == FuzzSeeds.TICK) frame.putLong(table + place, tick)
        } catch (_: MalformedFrameException) {
            // The host rejects it before it checks the tick.
        }
        return copy
    }

    /** The position of the first field's offset in a vtable, in bytes. */
    private const val FIRST_FIELD = 4
}
