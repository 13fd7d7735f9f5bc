package org.collektive.frames.tick

import org.collektive.frame.FrameLayouts
import org.collektive.frame.StepResponse
import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import org.collektive.frames.target
import java.nio.ByteBuffer

/**
 * Verifies and reads the `StepResponse` between position and limit of [frame].
 *
 * @throws org.collektive.frames.MalformedFrameException when it is malformed.
 */
public class StepResponseReader(public val frame: ByteBuffer) {
    /** The response; its actuator data is unverified. */
    public val response: StepResponse

    /** Position of the table `Actuators`, or 0 if it is absent. */
    public val actuators: Int

    init {
        val root = FrameChecker(FramePolicy.FRAME).checkRoot(frame, FrameLayouts.STEP_RESPONSE)
        response = StepResponse().__assign(root, frame)
        actuators = target(frame, root, FrameLayouts.STEP_RESPONSE_ACTUATORS)
    }
}
