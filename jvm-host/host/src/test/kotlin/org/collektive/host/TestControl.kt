package org.collektive.host

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.frame.ControlRequest
import org.collektive.frame.ControlResponse
import org.collektive.frame.RecordingAction
import org.collektive.frame.RecordingState
import java.nio.ByteBuffer
import java.nio.ByteOrder
import kotlin.test.assertTrue

/** Returns a `ControlRequest` as C# would write it. */
internal fun controlFrame(
    flags: List<String> = emptyList(),
    recording: Int = RecordingAction.Nothing,
    settings: String = "default",
    path: String = "",
    collect: Boolean = false,
): ByteBuffer {
    val builder = FlatBufferBuilder(256)
    val names = flags.map { builder.createString(it) }
    builder.finish(
        ControlRequest.createControlRequest(
            builder,
            ControlRequest.createFlagsVector(builder, names.toIntArray()),
            collect,
            recording,
            builder.createString(settings),
            builder.createString(path),
        ),
    )
    return direct(builder)
}

/** A separate [Control], which is called as C# calls it. */
internal class TestControl(private val shim: TestShim) {
    private val control = Control(shim)
    private var answer = ByteBuffer.allocateDirect(64)

    fun ask(
        flags: List<String> = emptyList(),
        recording: Int = RecordingAction.Nothing,
        settings: String = "default",
        path: String = "",
        collect: Boolean = false,
    ): ControlResponse {
        val frame = controlFrame(flags, recording, settings, path, collect)
        shim.grown = null
        val result = control.answer(frame, 7, answer)
        shim.grown?.let { answer = it }
        val offset = (result ushr 32).toInt()
        val bytes = answer.duplicate().order(ByteOrder.LITTLE_ENDIAN).clear().position(offset).limit(offset + result.toInt())
        return ControlResponse.getRootAsControlResponse(bytes)
    }

    /** Requests the action [recording] and waits until it is done. */
    fun record(recording: Int, settings: String = "default", path: String = ""): ControlResponse {
        ask(recording = recording, settings = settings, path = path)
        val deadline = System.nanoTime() + LIMIT_NANOS
        while (true) {
            val now = ask()
            if (now.recording() == RecordingState.Off || now.recording() == RecordingState.On) return now
            assertTrue(System.nanoTime() < deadline, "the recording is still ${RecordingState.name(now.recording())}")
            Thread.sleep(5)
        }
    }

    private companion object {
        const val LIMIT_NANOS = 60_000_000_000L
    }
}
