package crowd

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.stdlib.spreading.distanceTo
import it.unibo.collektive.stdlib.util.Point2D
import org.collektive.api.Device
import org.collektive.api.Parameter
import org.collektive.api.Program
import org.collektive.schema.Vector3
import org.collektive.schema.Vector3Value
import kotlin.math.sqrt

/**
 * Walks to a goal and keeps its distance from obstacles and other walkers, passing them on the right. Where the crowd is too dense, a
 * warning spreads a few hops. Walkers that receive it walk at half speed.
 */
@Program(
    "crowd",
    parameters = [
        Parameter("speed", "1.4", "Speed of a free walker in metres per second, greater than 0."),
        Parameter("limit", "0.9", "Walkers per square metre that trigger a warning."),
        Parameter("hops", "2", "Number of hops that a warning spreads."),
    ],
)
public fun Aggregate<Int>.crowd(sensors: SensorData, device: Device): ActuatorData {
    val position = requireNotNull(sensors.position()) { "the sensor data has no position" }
    val goal = requireNotNull(sensors.goal()) { "the sensor data has no goal" }
    val here = Point2D(position.x().toDouble() to position.z().toDouble())
    val speed = device.parameters.double("speed")
    val way = Steering()
    way.add(goal.x() - here.x, goal.z() - here.y, limit = 1.0)
    var close = 1
    for ((_, there) in neighboring(here).neighbors.list) {
        val distance = here.distanceTo(there)
        if (distance < DENSITY_RADIUS) close++
        way.avoid(there.x - here.x, there.y - here.y, distance - BODY)
    }
    val obstacle = Vector3()
    for (index in 0 until sensors.obstaclesLength()) {
        sensors.obstacles(obstacle, index)
        val x = obstacle.x().toDouble()
        val z = obstacle.z().toDouble()
        way.avoid(x, z, sqrt(x * x + z * z) - BODY / 2)
    }
    val crowding = close / DENSITY_AREA
    val isWarned = distanceTo(crowding > device.parameters.double("limit")) <= device.parameters.int("hops")
    val pace = if (isWarned) speed / 2 else speed
    return ActuatorData(velocity = way.velocity(pace), density = crowding.toFloat(), warned = isWarned)
}

/** The desired direction of a walker: a sum of vectors on the ground. */
private class Steering {
    private var x = 0.0
    private var z = 0.0

    /** Adds a vector, shortened to [limit]. */
    fun add(toX: Double, toZ: Double, limit: Double) {
        val length = sqrt(toX * toX + toZ * toZ)
        val scale = if (length > limit) limit / length else 1.0
        x += scale * toX
        z += scale * toZ
    }

    /** Adds a push away from an obstacle in the given direction, [gap] metres away, and slightly to the right. */
    fun avoid(toX: Double, toZ: Double, gap: Double) {
        val length = sqrt(toX * toX + toZ * toZ)
        if (gap > PERSONAL_SPACE || length < TOO_SMALL) return
        val push = PUSH * (1 - gap / PERSONAL_SPACE) * (1 - gap / PERSONAL_SPACE) / length
        x += push * (-toX + RIGHT_BIAS * toZ)
        z += push * (-toZ - RIGHT_BIAS * toX)
    }

    fun velocity(speed: Double): Vector3Value {
        val length = sqrt(x * x + z * z)
        val scale = if (length > 1) speed / length else speed
        return Vector3Value(x = (scale * x).toFloat(), z = (scale * z).toFloat())
    }
}

/** In metres: diameter of a body, gap below which a walker gives way, radius within which walkers are counted. */
private const val BODY = 0.5
private const val PERSONAL_SPACE = 1.2
private const val DENSITY_RADIUS = 2.0
private const val DENSITY_AREA = Math.PI * DENSITY_RADIUS * DENSITY_RADIUS

/** Weight of avoidance relative to the goal, and the share of it that points to the right. */
private const val PUSH = 4.0
private const val RIGHT_BIAS = 0.5
private const val TOO_SMALL = 1e-6
