package org.collektive.host.fuzz

import org.collektive.frames.MalformedFrameException
import org.collektive.frames.frameIn
import org.collektive.frames.session.openRequest
import org.collektive.host.Step
import org.collektive.host.TestSession
import org.collektive.host.TestShim
import org.collektive.host.direct
import org.collektive.host.shim.HostError

/** An `OpenRequest` of any bytes opens a session, or is refused and leaves none behind. */
internal object OpenFuzzer : Fuzzer {
    private val shim = TestShim()
    private val refusals = setOf(HostError.HOST, HostError.FRAME, HostError.SCHEMA, HostError.PROGRAM)

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
        if (namesRecord(bytes)) return false
        val session = TestSession(shim)
        val code = session.open(direct(bytes))
        requireRefusal(code, refusals, shim)
        if (code >= 0) {
            session.opened().programsLength()
            session.close()
        }
        check(session.step(Step(1).bytes()) == HostError.HANDLE.code.toLong()) { "a session is left" }
        return code >= 0
    }

    /** A record would be written wherever the bytes say. */
    private fun namesRecord(bytes: ByteArray): Boolean = try {
        openRequest(frameIn(direct(bytes), 0, bytes.size)).record().orEmpty().isNotEmpty()
    } catch (_: MalformedFrameException) {
        false
    }
}
