package org.collektive.host

import org.collektive.frame.ControlRequest
import org.collektive.frame.RecordingAction
import org.collektive.frames.AnswerBuffer
import org.collektive.frames.session.JvmState
import org.collektive.frames.session.controlRequest
import org.collektive.frames.session.writeControlResponse
import org.collektive.host.jfr.Recorder
import org.collektive.host.jvm.jvmFlag
import org.collektive.host.session.ShimSlots
import org.collektive.host.session.reading
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import org.collektive.host.shim.ShimCalls
import java.lang.management.ManagementFactory
import java.lang.management.MemoryType
import java.nio.ByteBuffer

/** Processes `ControlRequest` frames: reports the state of the JVM, and starts and stops its flight recording. */
internal class Control(shim: ShimCalls) {
    private var request = ControlRequest()
    private val buffer = AnswerBuffer(ShimSlots(shim))
    private val recorder = Recorder(shim)

    /** Executes the `ControlRequest` in [frame] and writes the `ControlResponse`. Returns its position, `offset << 32 | length`. */
    fun answer(frame: ByteBuffer, slot: Long, answer: ByteBuffer): Long {
        request = reading { controlRequest(frame) }
        record()
        if (request.collect()) System.gc()
        buffer.begin(slot, answer)
        return buffer.writeControlResponse(state())
    }

    /** Stops a running recording, and waits at most [limitMillis] milliseconds until its file is written. */
    fun close(limitMillis: Int) = recorder.close(limitMillis)

    private fun record() {
        val path = request.path().orEmpty()
        when (request.recording()) {
            RecordingAction.Nothing -> {}
            RecordingAction.Start -> recorder.start(request.settings().orEmpty(), path)
            RecordingAction.Dump -> recorder.dump(path)
            RecordingAction.Stop -> recorder.stop()
            else -> throw HostException(HostError.FRAME, "unknown recording action ${request.recording()}")
        }
    }

    /** Returns the state of the JVM. Reads the recorder's state first: once an action has ended, the other properties have its outcome. */
    private fun state(): JvmState {
        val recording = recorder.state
        val heap = ManagementFactory.getMemoryMXBean().heapMemoryUsage
        val metaspace = ManagementFactory.getMemoryPoolMXBeans().find { it.type == MemoryType.NON_HEAP && it.name == "Metaspace" }
        val collectors = ManagementFactory.getGarbageCollectorMXBeans()
        return JvmState(
            flags = flags(),
            heapUsed = heap.used,
            heapCommitted = heap.committed,
            heapMaximum = heap.max,
            metaspaceUsed = metaspace?.usage?.used ?: 0,
            classes = ManagementFactory.getClassLoadingMXBean().loadedClassCount,
            collections = collectors.sumOf { it.collectionCount.coerceAtLeast(0) },
            collectionMillis = collectors.sumOf { it.collectionTime.coerceAtLeast(0) },
            recording = recording.ordinal,
            recordingPath = recorder.path,
            recordingError = recorder.error,
            recordingMillis = recorder.millis,
            recordingsWritten = recorder.written,
            uptimeMillis = ManagementFactory.getRuntimeMXBean().uptime,
        )
    }

    /** Returns the values of the requested flags that this JVM has. */
    private fun flags(): Map<String, String> {
        val values = LinkedHashMap<String, String>()
        for (index in 0 until request.flagsLength()) {
            val name = request.flags(index)
            values[name] = jvmFlag(name) ?: continue
        }
        return values
    }
}
