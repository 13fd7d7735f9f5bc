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
import kotlin.math.PI
import kotlin.math.max
import kotlin.math.min

/**
 * Forms one shape after another. The drones elect a leader. Its clock determines the current shape, which spreads from neighbour to
 * neighbour. Each drone flies to its place on the shape, which follows from its place at the start, circles on round shapes, and keeps its
 * distance from other drones.
 */
@Program(
    "swarm",
    parameters = [
        Parameter("radius", "20.0", "Radius of the shapes in metres. All drones must fit on a sphere of this radius."),
        Parameter("shapeSeconds", "18.0", "Seconds between two shapes."),
        Parameter("speed", "12.0", "Maximum speed of a drone in metres per second."),
    ],
)
public fun Aggregate<Int>.swarm(sensors: SensorData, device: Device): ActuatorData {
    val position = requireNotNull(sensors.position()) { "the sensor data has no position" }
    val here = Point3D(Triple(position.x().toDouble(), position.y().toDouble(), position.z().toDouble()))
    val radius = device.parameters.double("radius")
    val start = evolve(here) { it }
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
        val speed = device.parameters.double("speed")
        val angularSpeed = if (shape.isRound) ROTATION_SHARE * speed / radius else 0.0
        val turned = partOfPad(start.x, radius) + angularSpeed * device.time / (2 * PI)
        val toPlace = shape.pointAt(turned, partOfPad(start.z, radius), radius) - fromMiddle
        off = toPlace.length
        // Slower than the maximum speed, so that drones can avoid others on the way.
        way += toPlace * min(PULL, PULL_SHARE * speed / max(off, TOO_SMALL)) + fromMiddle.around() * angularSpeed
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

/** The velocity of a point that turns around the vertical axis by a radian per second. */
private fun Point3D.around() = Point3D(Triple(-z, 0.0, x))

/** A coordinate of the square from which the drones start, from 0 to 1. */
private fun partOfPad(coordinate: Double, radius: Double) = (coordinate / (PAD * radius) + 0.5).coerceIn(0.0, 1.0)

private fun Point3D.toVector() = Vector3Value(x = x.toFloat(), y = y.toFloat(), z = z.toFloat())

/** Bound of the election in hops, at least the diameter of the swarm, so that one drone leads all others. */
private const val MAX_HOPS = 120
private const val NOT_YET = -1

/** Height of the centre of the shapes, in radii. */
private const val MIDDLE = 1.75

/** Side of the square from which the drones start, in radii. */
private const val PAD = 2.36

/** Speed of a drone in metres per second, for each metre of distance from its place. */
private const val PULL = 1.5

/** Greatest such speed, as a share of the maximum speed. */
private const val PULL_SHARE = 0.8

/** Distance in metres below which drones repel each other, and the strength of the repulsion. */
private const val MIN_DISTANCE = 1.5
private const val PUSH = 9.0

/** Speed at the equator of the sphere, as a share of the maximum speed. */
private const val ROTATION_SHARE = 0.4
private const val TOO_SMALL = 1e-6
