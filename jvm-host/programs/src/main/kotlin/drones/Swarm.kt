package drones

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.aggregate.values
import it.unibo.collektive.stdlib.consensus.boundedElection
import it.unibo.collektive.stdlib.util.Point3D
import org.collektive.api.Device
import org.collektive.api.Parameter
import org.collektive.api.Program
import org.collektive.schema.Vector3Value
import kotlin.math.sqrt

/**
 * Forms one shape after another. The drones elect a leader. Its clock determines the current shape, which spreads from neighbour to
 * neighbour. Each drone flies to the nearest point of the shape, circles on round shapes, and keeps its distance from other drones.
 */
@Program(
    "swarm",
    parameters = [
        Parameter("radius", "20.0", "Radius of the shapes in metres. All drones must fit on a sphere of this radius."),
        Parameter("shapeSeconds", "15.0", "Seconds between two shapes."),
        Parameter("speed", "8.0", "Maximum speed of a drone in metres per second."),
    ],
)
public fun Aggregate<Int>.swarm(sensors: SensorData, device: Device): ActuatorData {
    val position = requireNotNull(sensors.position()) { "the sensor data has no position" }
    val here = Point3D(Triple(position.x().toDouble(), position.y().toDouble(), position.z().toDouble()))
    val radius = device.parameters.double("radius")
    val leads = boundedElection(MAX_HOPS) == localId
    val turn = share(NOT_YET) { turns ->
        val receivedTurn = turns.all.values.list.max()
        if (leads) maxOf(receivedTurn, (device.time / device.parameters.double("shapeSeconds")).toInt()) else receivedTurn
    }
    var way = here.awayFrom(neighboring(here).neighbors.values.list)
    var off = 0.0
    if (turn != NOT_YET) {
        val fromMiddle = here - Point3D(Triple(0.0, MIDDLE * radius, 0.0))
        val shape = SHAPES[turn % SHAPES.size]
        val toShape = shape.vectorToSurface(fromMiddle, radius)
        off = toShape.length
        way += toShape * PULL
        if (shape.isRound) way += fromMiddle.around() * (ROTATION_SHARE * device.parameters.double("speed"))
    }
    return ActuatorData(
        target = (here + way).toVector(),
        shape = if (turn == NOT_YET) NOT_YET else turn % SHAPES.size,
        off = off.toFloat(),
        leads = leads,
    )
}

/** Returns the sum of the repulsions from [others] that are too close. */
private fun Point3D.awayFrom(others: List<Point3D>): Point3D {
    var x = 0.0
    var y = 0.0
    var z = 0.0
    for (other in others) {
        val distance = distanceTo(other)
        if (distance >= MIN_DISTANCE || distance < TOO_SMALL) continue
        val push = PUSH * (MIN_DISTANCE / distance - 1)
        x += push * (this.x - other.x)
        y += push * (this.y - other.y)
        z += push * (this.z - other.z)
    }
    return Point3D(Triple(x, y, z))
}

/** The direction in which a point turns around the vertical axis; 0 on the axis. */
private fun Point3D.around(): Point3D {
    val fromAxis = sqrt(x * x + z * z)
    return if (fromAxis < TOO_SMALL) ORIGIN else Point3D(Triple(-z / fromAxis, 0.0, x / fromAxis))
}

private fun Point3D.toVector() = Vector3Value(x = x.toFloat(), y = y.toFloat(), z = z.toFloat())

private val ORIGIN = Point3D(Triple(0.0, 0.0, 0.0))

/** Bound of the election in hops, at least the diameter of the swarm, so that one drone leads all others. */
private const val MAX_HOPS = 120
private const val NOT_YET = -1

/** Height of the centre of the shapes, in radii. */
private const val MIDDLE = 1.75

/** Speed of a drone in metres per second, for each metre of distance from the shape. */
private const val PULL = 1.5

/** Distance in metres below which drones repel each other, and the strength of the repulsion. */
private const val MIN_DISTANCE = 1.5
private const val PUSH = 3.0

/** Share of the speed with which drones turn around the axis. */
private const val ROTATION_SHARE = 0.4
private const val TOO_SMALL = 1e-6
