package org.collektive.host.fuzz

import org.collektive.frame.ControlResponse
import org.collektive.frame.RecordingAction
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.frameIn
import org.collektive.frames.session.controlRequest
import org.collektive.host.Host
import org.collektive.host.TestShim
import org.collektive.host.controlFrame
import org.collektive.host.direct
import org.collektive.host.shim.HostError
import java.nio.ByteBuffer
import java.nio.ByteOrder

/** Sends arbitrary bytes as a `ControlRequest`, which must be either answered, or rejected without an effect on the flight recorder. */
internal object ControlFuzzer : Fuzzer {
    private const val ANSWER_BYTES = 1 shl 16
    private val shim = TestShim()
    private val refusals = setOf(HostError.FRAME)

    /** Tests an input. Jazzer calls this for each one. */
    @JvmStatic
    fun fuzzerTestOneInput(bytes: ByteArray) {
        run(bytes)
    }

    override fun run(bytes: ByteArray): Boolean {
        Host.shim = shim
        if (isSkipped(bytes)) return false
        val code = Host.control(0, direct(bytes), 0, bytes.size, 1, ByteBuffer.allocateDirect(ANSWER_BYTES), LIMIT_MILLIS)
        requireRefusal(code, refusals, shim)
        if (code < 0) requireNoRecording()
        return code >= 0
    }

    private fun requireNoRecording() {
        val frame = controlFrame()
        val answer = ByteBuffer.allocateDirect(ANSWER_BYTES).order(ByteOrder.LITTLE_ENDIAN)
        val place = Host.control(0, frame, 0, frame.capacity(), 1, answer, LIMIT_MILLIS)
        check(place >= 0) { shim.error }
        val state = ControlResponse.getRootAsControlResponse(answer.position((place ushr Int.SIZE_BITS).toInt()))
        check(state.recordingPath() == null && state.recordingsWritten() == 0) { "a rejected control request started a recording" }
    }

    /**
     * Returns whether a request is skipped.
     *
     * These requests could record to any path, or run a garbage collection, which takes a thousand times as long as other requests.
     */
    private fun isSkipped(bytes: ByteArray): Boolean = try {
        val request = controlRequest(frameIn(direct(bytes), 0, bytes.size))
        request.collect() || request.recording() in RecordingAction.Start..RecordingAction.Stop
    } catch (_: MalformedFrameException) {
        false
    }

    private const val LIMIT_MILLIS = 1000
}
