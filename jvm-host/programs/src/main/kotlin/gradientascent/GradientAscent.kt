package gradientascent

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.neighboring
import org.collektive.api.Device
import org.collektive.api.Parameter
import org.collektive.api.Program
import org.collektive.schema.Vector3
import org.collektive.schema.Vector3Value
import kotlin.math.sqrt

/**
 * Climbs towards the source. A neighbour that senses a higher intensity than this node attracts it, one that senses a lower intensity
 * repels it, in proportion to the difference. An obstacle nearby repels it, more strongly the nearer it is.
 *
 * The result is the point one step away in the direction of the sum, at the same height.
 */
@Program("gradient-ascent", parameters = [Parameter("step", "1.0", "Distance from a node to its target in metres, 0 or greater.")])
public fun Aggregate<Int>.gradientAscent(sensors: SensorData, device: Device): ActuatorData {
    val position = requireNotNull(sensors.position()) { "the sensor data has no position" }
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
    return ActuatorData(Vector3Value((here.x + scale * x).toFloat(), here.y, (here.z + scale * z).toFloat()))
}

/** The message to neighbours: the position of the node, and the intensity there. */
private class Sample(val x: Float, val y: Float, val z: Float, val intensity: Float) {
    fun distanceTo(other: Sample): Double = length((other.x - x).toDouble(), (other.y - y).toDouble(), (other.z - z).toDouble())
}

private fun length(x: Double, y: Double, z: Double): Double = sqrt(x * x + y * y + z * z)

/** Vectors shorter than this have no usable direction. */
private const val TOO_SMALL = 1e-6

/** Metres within which an obstacle repels, and its weight relative to neighbours. */
private const val OBSTACLE_RANGE = 1.0
private const val OBSTACLE_WEIGHT = 2.0
