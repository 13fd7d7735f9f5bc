package rescue

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.stdlib.spreading.distanceTo
import it.unibo.collektive.stdlib.spreading.gradientCast
import it.unibo.collektive.stdlib.util.Point2D
import it.unibo.collektive.stdlib.util.euclideanDistance2D
import org.collektive.api.Device
import org.collektive.api.Parameter
import org.collektive.api.Program
import org.collektive.schema.Vector3
import org.collektive.schema.Vector3Value
import kotlin.math.sqrt

/**
 * Explores a ruin and keeps a channel from the base to each casualty that was found. One robot stays with each casualty. Robots on the
 * shortest path to the base keep their positions, and the others spread. Decisions depend only on the neighbours' latest messages, so a
 * failed robot is replaced and a broken channel is rebuilt.
 */
@Program(
    "rescue",
    parameters = [
        Parameter("speed", "2.5", "Speed of an exploring robot in metres per second, greater than 0."),
        Parameter("spacing", "7.5", "Distance between exploring robots in metres, greater than 0 and less than the range."),
        Parameter("casualties", "3", "Maximum number of casualties, 0 or greater. Casualties are numbered from 0."),
        Parameter("width", "1.0", "Maximum detour of a path through a robot of the channel, in metres, 0 or greater."),
    ],
)
public fun Aggregate<Int>.rescue(sensors: SensorData, device: Device): ActuatorData {
    val position = requireNotNull(sensors.position()) { "the sensor data has no position" }
    val here = Point2D(position.x().toDouble() to position.z().toDouble())
    val metric = euclideanDistance2D(here)
    val staysWithCasualty = staysWith(sensors.casualty())
    val toBase = distanceTo(sensors.base(), metric)
    val width = device.parameters.double("width")
    val pathCount = (0 until device.parameters.int("casualties")).count { casualty ->
        alignedOn(casualty) { isOnPath(toBase, staysWithCasualty && sensors.casualty() == casualty, metric, width) }
    }
    val role = when {
        sensors.base() -> BASE
        staysWithCasualty -> WITH_CASUALTY
        pathCount > 0 -> CHANNEL
        else -> EXPLORER
    }
    val others = neighboring(Other(here, toBase)).neighbors.list.map { it.value }
    val heading = evolve(device.random.nextDouble(2 * StrictMath.PI)) { it + TURN * (device.random.nextDouble() - 0.5) }
    val drive = Drive()
    if (role == EXPLORER) {
        drive.add(StrictMath.cos(heading), StrictMath.sin(heading), HEADING_WEIGHT)
        drive.spread(Other(here, toBase), others, device.parameters.double("spacing"))
    }
    drive.avoid(sensors)
    return ActuatorData(
        velocity = drive.velocity(device.parameters.double("speed")),
        role = role,
        distance = if (toBase.isFinite()) toBase.toFloat() else -1f,
    )
}

/** Whether this robot is on or near the shortest path from a casualty to the base. The robot with the casualty broadcasts its length. */
private fun Aggregate<Int>.isOnPath(toBase: Double, isWithIt: Boolean, metric: Field<Int, Double>, width: Double): Boolean {
    val way = toBase + distanceTo(isWithIt, metric)
    val length = gradientCast(isWithIt, toBase, metric)
    return way.isFinite() && way <= length + width + ROUNDING
}

/** Whether this robot stays with the casualty that it sees. Of neighbours that see the same one, the robot with the lowest id stays. */
private fun Aggregate<Int>.staysWith(casualty: Int): Boolean {
    val seen = neighboring(casualty)
    return casualty >= 0 && seen.neighbors.list.none { (id, theirs) -> theirs == casualty && id < localId }
}

/** The position of a robot, and its distance from the base along links, in metres. */
private data class Other(val place: Point2D, val toBase: Double)

/** The desired direction of a robot: a sum of vectors on the ground. */
private class Drive {
    private var x = 0.0
    private var z = 0.0

    fun add(toX: Double, toZ: Double, weight: Double) {
        x += weight * toX
        z += weight * toZ
    }

    /** Moves away from robots nearer than [spacing], most from those nearer to the base, or to the nearest robot if all are farther. */
    fun spread(me: Other, others: List<Other>, spacing: Double) {
        val here = me.place
        var nearest = here
        var least = Double.POSITIVE_INFINITY
        for ((there, toBase) in others) {
            val distance = here.distanceTo(there)
            if (distance < least) {
                least = distance
                nearest = there
            }
            if (distance > spacing || distance < TOO_SMALL) continue
            val push = (1 - distance / spacing) / distance
            add(here.x - there.x, here.y - there.y, if (toBase < me.toBase) OUTWARDS * push else push)
        }
        if (least.isFinite() && least > spacing) add(nearest.x - here.x, nearest.y - here.y, 1 / least)
    }

    /** Moves away from obstacles, more strongly the nearer they are. */
    fun avoid(sensors: SensorData) {
        val obstacle = Vector3()
        for (index in 0 until sensors.obstaclesLength()) {
            sensors.obstacles(obstacle, index)
            val toX = obstacle.x().toDouble()
            val toZ = obstacle.z().toDouble()
            val length = sqrt(toX * toX + toZ * toZ)
            if (length > MIN_DISTANCE || length < TOO_SMALL) continue
            add(-toX, -toZ, PUSH * (1 - length / MIN_DISTANCE) / length)
        }
    }

    fun velocity(speed: Double): Vector3Value {
        val length = sqrt(x * x + z * z)
        val scale = if (length > 1) speed / length else speed
        return Vector3Value(x = (scale * x).toFloat(), z = (scale * z).toFloat())
    }
}

/** The roles of `rescue.fbs`. */
private const val EXPLORER = 0
private const val CHANNEL = 1
private const val WITH_CASUALTY = 2
private const val BASE = 3

/** Weight of a robot's own heading, and the range of its random turn per round in radians, half to either side. */
private const val HEADING_WEIGHT = 0.5
private const val TURN = 0.6

/** Factor by which robots nearer to the base repel more strongly than others. */
private const val OUTWARDS = 2.0

/** Distance in metres from a robot's centre below which it avoids obstacles, and the weight of the avoidance. */
private const val MIN_DISTANCE = 1.3
private const val PUSH = 3.0
private const val TOO_SMALL = 1e-6

/** Metres by which sums of the same lengths may differ, because their order differs. */
private const val ROUNDING = 1e-6
