package leaderelection

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.consensus.boundedElection
import it.unibo.collektive.stdlib.spreading.distanceTo
import it.unibo.collektive.stdlib.util.euclideanDistance2D
import org.collektive.api.Device
import org.collektive.api.Parameter
import org.collektive.api.Program

/**
 * Divides the swarm into regions, each with a leader at most `radius` metres away along links. The greatest id leads all nodes within the
 * radius; of the remaining nodes, the greatest id leads those around it, and so on. When a leader fails, its region elects another.
 */
@Program(
    "leader-election",
    parameters = [Parameter("radius", "20.0", "Radius of a region in metres along links, greater than 0.")],
)
public fun Aggregate<Int>.leaderElection(sensors: SensorData, device: Device): ActuatorData {
    val metric = euclideanDistance2D(sensors.position().x().toDouble() to sensors.position().z().toDouble())
    val elected = boundedElection(device.parameters.double("radius"), metric)
    val toNearest = distanceTo(elected == localId, metric)
    return ActuatorData(leader = elected, distance = if (toNearest.isFinite()) toNearest.toFloat() else -1f)
}
