package channel

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.spreading.distanceTo
import it.unibo.collektive.stdlib.spreading.gradientCast
import it.unibo.collektive.stdlib.util.euclideanDistance2D
import org.collektive.api.Device
import org.collektive.api.Parameter
import org.collektive.api.Program

/**
 * Marks the nodes on the shortest path from the source to the target, and those close to it. Each node computes its distance to both,
 * along links; the target broadcasts the length of the shortest path.
 */
@Program(
    "channel",
    parameters = [
        Parameter("width", "2.0", "Metres by which a path through a node of the channel may exceed the shortest path, 0 or greater."),
    ],
)
public fun Aggregate<Int>.channel(sensors: SensorData, device: Device): ActuatorData {
    val metric = euclideanDistance2D(sensors.position().x().toDouble() to sensors.position().z().toDouble())
    val fromSource = distanceTo(sensors.source(), metric)
    val toTarget = distanceTo(sensors.target(), metric)
    val length = gradientCast(sensors.target(), fromSource, metric)
    val way = fromSource + toTarget
    return ActuatorData(
        inChannel = way.isFinite() && way <= length + device.parameters.double("width") + ROUNDING,
        distance = if (fromSource.isFinite()) fromSource.toFloat() else -1f,
    )
}

/** Metres by which sums of the same lengths may differ, because their order differs. */
private const val ROUNDING = 1e-6
