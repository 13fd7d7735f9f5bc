package org.collektive.host.fuzz

import org.collektive.frames.MalformedFrameException
import org.collektive.frames.frameIn
import org.collektive.frames.session.openRequest
import org.collektive.host.Step
import org.collektive.host.TestSession
import org.collektive.host.TestShim
import org.collektive.host.direct
import org.collektive.host.shim.HostError

/** Sends arbitrary bytes as an `OpenRequest`, which must either open a session, or be rejected and leave no session open. */
internal object OpenFuzzer : Fuzzer {
    private val shim = TestShim()
    private val refusals = setOf(HostError.HOST, HostError.FRAME, HostError.SCHEMA, HostError.PROGRAM)

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
        if (namesRecord(bytes)) return false
        val session = TestSession(shim)
        val code = session.open(direct(bytes))
        requireRefusal(code, refusals, shim)
        if (code >= 0) {
            session.opened().programsLength()
            session.close()
        }
        check(session.step(Step(1).bytes()) == HostError.HANDLE.code.toLong()) { "a session was left open" }
        return code >= 0
    }

    /** Returns whether a request names a record. Such a request is skipped, because it could write to any path. */
    private fun namesRecord(bytes: ByteArray): Boolean = try {
        openRequest(frameIn(direct(bytes), 0, bytes.size)).record().orEmpty().isNotEmpty()
    } catch (_: MalformedFrameException) {
        false
    }
}
