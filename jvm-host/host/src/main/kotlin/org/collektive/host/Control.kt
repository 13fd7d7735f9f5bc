package org.collektive.host

import com.google.flatbuffers.FlatBufferBuilder
import com.sun.management.HotSpotDiagnosticMXBean
import org.collektive.frame.ControlRequest
import org.collektive.frame.ControlResponse
import org.collektive.frame.Flag
import org.collektive.frame.RecordingAction
import org.collektive.host.jfr.Recorder
import java.lang.management.ManagementFactory
import java.lang.management.MemoryType
import java.nio.ByteBuffer

/** Tells about the JVM itself, and starts and stops its recording. */
internal class Control(shim: ShimCalls) {
    private val verifier = FrameVerifier()
    private val request = ControlRequest()
    private val buffer = AnswerBuffer(shim)
    private val recorder = Recorder(shim)
    private val diagnostics by lazy { ManagementFactory.getPlatformMXBean(HotSpotDiagnosticMXBean::class.java) }

    /** Does what [frame] asks for, and writes the `ControlResponse`. */
    fun answer(frame: ByteBuffer, slot: Long, answer: ByteBuffer): Long {
        request.__assign(verifier.verify(frame, FrameShapes.controlRequest), frame)
        record()
        if (request.collect()) System.gc()
        buffer.begin(slot, answer)
        return buffer.finish(write(buffer.builder))
    }

    /** Ends a running recording in order; waits for its file at most [limitMillis]. */
    fun close(limitMillis: Int) = recorder.close(limitMillis)

    private fun record() {
        val path = request.path().orEmpty()
        when (request.recording()) {
            RecordingAction.Nothing -> {}
            RecordingAction.Start -> recorder.start(request.settings().orEmpty(), path)
            RecordingAction.Dump -> recorder.dump(path)
            RecordingAction.Stop -> recorder.stop()
            else -> throw HostException(HostError.FRAME, "there is no recording action ${request.recording()}")
        }
    }

    private fun write(builder: FlatBufferBuilder): Int {
        val flags = (0 until request.flagsLength()).mapNotNull { writeFlag(builder, request.flags(it)) }
        val vector = ControlResponse.createFlagsVector(builder, flags.toIntArray())
        // Before the rest: who reads that an action has ended gets what came of it.
        val state = recorder.state
        val path = recorder.path?.let(builder::createString) ?: 0
        val error = recorder.error?.let(builder::createString) ?: 0
        ControlResponse.startControlResponse(builder)
        ControlResponse.addFlags(builder, vector)
        writeMemory(builder)
        ControlResponse.addRecording(builder, state.ordinal)
        if (path != 0) ControlResponse.addRecordingPath(builder, path)
        if (error != 0) ControlResponse.addRecordingError(builder, error)
        ControlResponse.addRecordingMillis(builder, recorder.millis)
        ControlResponse.addRecordingsWritten(builder, recorder.written)
        return ControlResponse.endControlResponse(builder)
    }

    private fun writeFlag(builder: FlatBufferBuilder, name: String): Int? {
        val value = try {
            diagnostics.getVMOption(name).value
        } catch (_: IllegalArgumentException) {
            return null
        }
        return Flag.createFlag(builder, builder.createString(name), builder.createString(value))
    }

    private fun writeMemory(builder: FlatBufferBuilder) {
        val heap = ManagementFactory.getMemoryMXBean().heapMemoryUsage
        ControlResponse.addHeapUsed(builder, heap.used)
        ControlResponse.addHeapCommitted(builder, heap.committed)
        ControlResponse.addHeapMaximum(builder, heap.max)
        val metaspace = ManagementFactory.getMemoryPoolMXBeans().find { it.type == MemoryType.NON_HEAP && it.name == "Metaspace" }
        ControlResponse.addMetaspaceUsed(builder, metaspace?.usage?.used ?: 0)
        ControlResponse.addClasses(builder, ManagementFactory.getClassLoadingMXBean().loadedClassCount)
        val collectors = ManagementFactory.getGarbageCollectorMXBeans()
        ControlResponse.addCollections(builder, collectors.sumOf { it.collectionCount.coerceAtLeast(0) })
        ControlResponse.addCollectionMillis(builder, collectors.sumOf { it.collectionTime.coerceAtLeast(0) })
    }
}
