package org.collektive.host.record

import org.collektive.frame.StepResponse
import org.collektive.host.FrameShapes
import org.collektive.host.FrameVerifier
import java.nio.ByteBuffer

/** A `StepResponse` that was checked, between position and limit of [frame]. */
internal class AnswerFrame(val frame: ByteBuffer) {
    val response: StepResponse

    /** Position of the table `Actuators`; 0 when absent. */
    val actuators: Int

    init {
        val verifier = FrameVerifier()
        val root = verifier.verify(frame, FrameShapes.stepResponse)
        response = StepResponse().__assign(root, frame)
        actuators = verifier.target(root, FrameShapes.ACTUATORS)
    }
}
