package gradientascent

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.neighboring
import org.collektive.api.Device
import org.collektive.api.Parameter
import org.collektive.api.Program
import org.collektive.schema.Vector3
import org.collektive.schema.Vector3T
import kotlin.math.sqrt

/**
 * Climbs towards the source: each neighbour pulls along its direction by how much more of the source it senses than this node (and
 * pushes by how much less), and each obstacle nearby pushes away, the nearer the harder.
 *
 * The answer is a point one step away in that direction, at the same height.
 */
@Program("gradient-ascent", parameters = [Parameter("step", "1.0", "Metres from a node to its target, 0 or greater.")])
public fun Aggregate<Int>.gradientAscent(sensors: SensorData, device: Device): ActuatorDataT {
    val position = requireNotNull(sensors.position()) { "the sensors give no position" }
    val here = Sample(position.x(), position.y(), position.z(), sensors.intensity())
    var x = 0.0
    var z = 0.0
    for ((_, there) in neighboring(here).neighbors.list) {
        val distance = here.distanceTo(there)
        if (distance < TOO_SMALL) continue
        val pull = (there.intensity - here.intensity) / distance
        x += pull * (there.x - here.x)
        z += pull * (there.z - here.z)
    }
    val obstacle = Vector3()
    for (index in 0 until sensors.obstaclesLength()) {
        sensors.obstacles(obstacle, index)
        val distance = length(obstacle.x().toDouble(), obstacle.y().toDouble(), obstacle.z().toDouble())
        if (distance < TOO_SMALL || distance > OBSTACLE_RANGE) continue
        val push = OBSTACLE_WEIGHT / (distance * distance * distance)
        x -= push * obstacle.x()
        z -= push * obstacle.z()
    }
    val length = length(x, 0.0, z)
    val scale = if (length < TOO_SMALL) 0.0 else device.parameters.double("step") / length
    return ActuatorDataT().apply {
        target = Vector3T().apply {
            this.x = (here.x + scale * x).toFloat()
            this.y = here.y
            this.z = (here.z + scale * z).toFloat()
        }
    }
}

/** What a node tells its neighbours: where it is, and what it senses there. */
private class Sample(val x: Float, val y: Float, val z: Float, val intensity: Float) {
    fun distanceTo(other: Sample): Double =
        length((other.x - x).toDouble(), (other.y - y).toDouble(), (other.z - z).toDouble())
}

private fun length(x: Double, y: Double, z: Double): Double = sqrt(x * x + y * y + z * z)

/** Below this a vector has no direction worth following. */
private const val TOO_SMALL = 1e-6

/** Metres within which an obstacle pushes, and how hard against the pull of neighbours. */
private const val OBSTACLE_RANGE = 1.0
private const val OBSTACLE_WEIGHT = 2.0
