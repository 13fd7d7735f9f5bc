package org.collektive.frames.session

import org.collektive.frame.ControlRequest
import org.collektive.frame.ControlResponse
import org.collektive.frame.Flag
import org.collektive.frame.FrameLayouts
import org.collektive.frames.AnswerBuffer
import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import java.nio.ByteBuffer

/**
 * Verifies and returns the `ControlRequest` between position and limit of [frame].
 *
 * @throws org.collektive.frames.MalformedFrameException when it is malformed.
 */
public fun controlRequest(frame: ByteBuffer): ControlRequest =
    ControlRequest().__assign(FrameChecker(FramePolicy.FRAME).checkRoot(frame, FrameLayouts.CONTROL_REQUEST), frame)

/**
 * The state of the JVM that a `ControlResponse` reports. Sizes are in bytes, times in milliseconds.
 *
 * @property flags values of JVM flags by name.
 * @property heapUsed heap in use, garbage included.
 * @property heapCommitted heap memory that the operating system has committed to the JVM.
 * @property heapMaximum maximum heap size.
 * @property metaspaceUsed memory of loaded classes.
 * @property classes number of loaded classes.
 * @property collections number of garbage collections since the start.
 * @property collectionMillis total time of these collections.
 * @property recording a value of `RecordingState`.
 * @property recordingPath file of the running or last flight recording; `null` before the first.
 * @property recordingError why the last action on a recording failed; `null` if it succeeded.
 * @property recordingMillis duration of that action.
 * @property recordingsWritten recordings and dumps written so far.
 * @property uptimeMillis milliseconds since the start of the JVM.
 */
public class JvmState(
    public val flags: Map<String, String>,
    public val heapUsed: Long,
    public val heapCommitted: Long,
    public val heapMaximum: Long,
    public val metaspaceUsed: Long,
    public val classes: Int,
    public val collections: Long,
    public val collectionMillis: Long,
    public val recording: Int,
    public val recordingPath: String?,
    public val recordingError: String?,
    public val recordingMillis: Int,
    public val recordingsWritten: Int,
    public val uptimeMillis: Long,
)

/** Writes a `ControlResponse` with [state]. Returns its position, see [AnswerBuffer.finish]. */
public fun AnswerBuffer.writeControlResponse(state: JvmState): Long {
    val flags = state.flags.map { (name, value) -> Flag.createFlag(builder, builder.createString(name), builder.createString(value)) }
    val vector = ControlResponse.createFlagsVector(builder, flags.toIntArray())
    val path = state.recordingPath?.let(builder::createString) ?: 0
    val error = state.recordingError?.let(builder::createString) ?: 0
    ControlResponse.startControlResponse(builder)
    ControlResponse.addFlags(builder, vector)
    ControlResponse.addHeapUsed(builder, state.heapUsed)
    ControlResponse.addHeapCommitted(builder, state.heapCommitted)
    ControlResponse.addHeapMaximum(builder, state.heapMaximum)
    ControlResponse.addMetaspaceUsed(builder, state.metaspaceUsed)
    ControlResponse.addClasses(builder, state.classes)
    ControlResponse.addCollections(builder, state.collections)
    ControlResponse.addCollectionMillis(builder, state.collectionMillis)
    ControlResponse.addRecording(builder, state.recording)
    if (path != 0) ControlResponse.addRecordingPath(builder, path)
    if (error != 0) ControlResponse.addRecordingError(builder, error)
    ControlResponse.addRecordingMillis(builder, state.recordingMillis)
    ControlResponse.addRecordingsWritten(builder, state.recordingsWritten)
    ControlResponse.addUptimeMillis(builder, state.uptimeMillis)
    return finish(ControlResponse.endControlResponse(builder))
}
