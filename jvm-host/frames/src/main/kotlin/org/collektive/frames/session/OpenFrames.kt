package org.collektive.frames.session

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.api.Parameter
import org.collektive.api.Program
import org.collektive.frame.FrameLayouts
import org.collektive.frame.OpenRequest
import org.collektive.frame.OpenRequestT
import org.collektive.frame.OpenResponse
import org.collektive.frame.ParameterInfo
import org.collektive.frame.ProgramInfo
import org.collektive.frames.AnswerBuffer
import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import java.nio.ByteBuffer

/**
 * Verifies and returns the `OpenRequest` between position and limit of [frame].
 *
 * @throws org.collektive.frames.MalformedFrameException when it is malformed.
 */
public fun openRequest(frame: ByteBuffer): OpenRequest =
    OpenRequest().__assign(FrameChecker(FramePolicy.FRAME).checkRoot(frame, FrameLayouts.OPEN_REQUEST), frame)

/** Serialises [request], such as one that was read and changed. */
public fun openFrame(request: OpenRequestT): ByteBuffer {
    val builder = FlatBufferBuilder()
    builder.finish(OpenRequest.pack(builder, request))
    return builder.dataBuffer()
}

/** Fingerprints of the user's types by name. */
public val OpenRequest.types: Map<String, Long>
    get() = (0 until typesLength()).associate { index -> types(index).let { it.name() to it.hash() } }

/** The names of the parameter's possible values; empty if any text is possible. */
public val Parameter.constants: List<String>
    get() = values.java.enumConstants.orEmpty().map { it.name }

/** Writes an `OpenResponse` that lists [programs]. Returns its position, see [AnswerBuffer.finish]. */
public fun AnswerBuffer.writeOpenResponse(programs: Collection<Program>): Long {
    val vector = OpenResponse.createProgramsVector(builder, writePrograms(programs))
    return finish(OpenResponse.createOpenResponse(builder, vector))
}

/** Writes a `ProgramInfo` of each of [programs], and returns their offsets. */
internal fun AnswerBuffer.writePrograms(programs: Collection<Program>): IntArray {
    val infos = programs.map { program ->
        val parameters = program.parameters.map {
            ParameterInfo.createParameterInfo(
                builder,
                builder.createString(it.name),
                builder.createString(it.default),
                builder.createString(it.description),
                ParameterInfo.createValuesVector(builder, it.constants.map(builder::createString).toIntArray()),
            )
        }
        val name = builder.createString(program.name)
        ProgramInfo.createProgramInfo(builder, name, ProgramInfo.createParametersVector(builder, parameters.toIntArray()))
    }
    return infos.toIntArray()
}
