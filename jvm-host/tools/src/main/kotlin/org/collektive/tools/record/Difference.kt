package org.collektive.tools.record

import org.collektive.frame.FrameLayouts
import org.collektive.frame.OpenRequest
import org.collektive.frame.StepRequest
import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.target
import org.collektive.frames.tick.StepResponseReader
import java.nio.ByteBuffer

/** One difference of two frames: the owner of the data ("node 3", or empty), the field (or empty), and both values. */
internal class Difference(private val owner: String, private val field: String, private val left: String, private val right: String) {
    /** Returns the difference as one line; [names] are the names of the two sides. */
    fun line(names: Pair<String, String>): String {
        val place = listOf(owner, field).filter(String::isNotEmpty).joinToString(", ")
        return "$place: $left in ${names.first}, $right in ${names.second}"
    }

    companion object {
        /**
         * Fields without an effect on results. This includes paths of jars, which are compared by content, and the runtime, which is reported
         * separately.
         */
        private val WITHOUT_EFFECT = setOf("threads", "record", "jars", "runtime", "runtimeJars")

        /** Fields that are not compared: measured times, the message of a reload, and the digest, which differs only if another field differs. */
        private val MEASURED = setOf("digest", "hostMicros", "roundMicros", "inspection.roundNanos", "reload")

        /** Reloaded programs, which are compared by content. */
        private val RELOADED = setOf("reload")

        /** Returns the first difference that can change the results of a session, or `null`. */
        fun ofOpen(left: OpenRequest, right: OpenRequest): Difference? =
            ObjectDifference.first(left.unpack(), right.unpack(), except = WITHOUT_EFFECT)

        /** Returns the first difference of two inputs of a tick, or `null`. The order of their changes does not matter. */
        fun ofRequests(types: RecordedTypes, left: ByteBuffer, right: ByteBuffer): Difference? {
            if (left == right) return null
            val a = Request.read(types, left)
            val b = Request.read(types, right)
            if (a == null || b == null) return Difference("", "the request", kind(a), kind(b))
            return ObjectDifference.first(a.frame, b.frame, except = RELOADED)
                ?: ofNodes("sensors", a.sensors, b.sensors)
                ?: ObjectDifference.first(a.globals, b.globals, field = "globals")
        }

        /** Returns the first difference of two outputs of a tick, or `null`. */
        fun ofAnswers(types: RecordedTypes, left: StepResponseReader, right: StepResponseReader): Difference? =
            ofNodes("actuators", actuators(types, left), actuators(types, right))
                ?: ObjectDifference.first(left.response.unpack(), right.response.unpack(), except = MEASURED)

        private fun kind(request: Request?) = if (request == null) "damaged" else "valid"

        private fun ofNodes(field: String, left: Map<Int, Any>, right: Map<Int, Any>): Difference? =
            (left.keys + right.keys).sorted().firstNotNullOfOrNull { node ->
                ObjectDifference.first(left[node], right[node], owner = "node $node", field = field)
            }

        private fun actuators(types: RecordedTypes, answer: StepResponseReader): Map<Int, Any> {
            val response = answer.response
            return types.actuators(answer.frame, answer.actuators, response.nodesLength(), response::nodes)
        }
    }

    /** A `StepRequest`, converted to objects and maps. */
    private class Request(val frame: Any, val sensors: Map<Int, Any>, val globals: Any?) {
        companion object {
            /** Reads [bytes], or returns `null` if they are damaged: a record may contain a frame that the host rejected. */
            fun read(types: RecordedTypes, bytes: ByteBuffer): Request? = try {
                val root = FrameChecker(FramePolicy.FRAME).checkRoot(bytes, FrameLayouts.STEP_REQUEST)
                val request = StepRequest().__assign(root, bytes)
                val sensors = target(bytes, root, FrameLayouts.STEP_REQUEST_SENSORS)
                val globals = target(bytes, root, FrameLayouts.STEP_REQUEST_GLOBALS)
                Request(
                    request.unpack(),
                    types.sensors(bytes, sensors, request.dueLength(), request::due),
                    types.globals(bytes, globals),
                )
            } catch (_: MalformedFrameException) {
                null
            }
        }
    }
}
