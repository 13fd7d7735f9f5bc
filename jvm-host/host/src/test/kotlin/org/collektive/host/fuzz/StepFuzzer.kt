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
 * A `StepRequest` of any bytes, as the second tick of a small network, runs, or is refused and changes nothing.
 *
 * Two sessions get the same frames, except that only one gets the refused ones: they must stay equal. They live on from input to input,
 * since opening one takes a hundred times as long as a tick, so a frame of tick 2 is made one of the sessions' next tick.
 */
internal object StepFuzzer : Fuzzer {
    private val shim = TestShim()
    private val refusals = setOf(HostError.FRAME, HostError.PROGRAM)
    private var pair: Twins? = null

    /** What Jazzer calls before all inputs, without a limit: it compiles the programs. */
    @JvmStatic
    fun fuzzerInitialize() = FuzzedPrograms.place()

    /** What Jazzer calls. */
    @JvmStatic
    fun fuzzerTestOneInput(bytes: ByteArray) {
        run(bytes)
    }

    override fun run(bytes: ByteArray): Boolean {
        FuzzedPrograms.place()
        val twins = pair ?: Twins()
        // After a broken rule the next input begins with others.
        pair = null
        val accepted = twins.run(bytes)
        pair = twins
        return accepted
    }

    private class Twins {
        private val fuzzed = opened()
        private val spared = opened()
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
            check(spared.step(direct(frame)) >= 0) { "one session took the frame, the other refused it: ${shim.error}" }
            tick++
            val request = StepRequest.getRootAsStepRequest(ByteBuffer.wrap(frame))
            val gone = (0 until request.nodesRemovedLength()).map(request::nodesRemoved).toSet()
            nodes = (nodes - gone + (0 until request.nodesAddedLength()).map { request.nodesAdded(it).id() }).sorted()
            same { Step(tick).apply { due = nodes } }
            startAgain()
            return true
        }

        private fun startAgain() {
            val present = nodes
            nodes = FuzzSeeds.firstTick().added.map(Step.Added::id)
            same { FuzzSeeds.firstTick(tick).apply { removed = present } }
        }

        /** Both run [step] and answer the same. */
        private fun same(step: () -> Step) {
            check(outcome(fuzzed.ok(step())) == outcome(spared.ok(step()))) { "the sessions differ after: ${shim.error}" }
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

    /** [bytes], with [tick] in place of tick 2 when they are a frame that says so. */
    private fun ofTick(tick: Long, bytes: ByteArray): ByteArray {
        val copy = bytes.copyOf()
        try {
            val frame = frameIn(ByteBuffer.wrap(copy), 0, copy.size)
            val table = FrameChecker(FramePolicy.FRAME).checkRoot(frame, FrameLayouts.STEP_REQUEST)
            val vtable = table - frame.getInt(table)
            val place = if (frame.getShort(vtable) > FIRST_FIELD) frame.getShort(vtable + FIRST_FIELD).toInt() else 0
            if (place != 0 && frame.getLong(table + place) == FuzzSeeds.TICK) frame.putLong(table + place, tick)
        } catch (_: MalformedFrameException) {
            // The host refuses it before it looks at the tick.
        }
        return copy
    }

    /** Where vtables say where the first field is, in bytes. */
    private const val FIRST_FIELD = 4
}
