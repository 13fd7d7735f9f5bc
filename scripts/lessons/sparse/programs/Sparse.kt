// A sparse choice elects several leaders, so that each node has one within a given distance. It divides the swarm
// into areas of about this size, for example to collect data in each of them.
//
// Question: double `radius`. How many leaders remain, and how many do you expect?

package sparse

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.consensus.boundedElection
import it.unibo.collektive.stdlib.spreading.distanceTo
import org.collektive.api.Device
import org.collektive.api.Parameter
import org.collektive.api.Program
import org.collektive.links.distances
import standard.ActuatorData
import standard.SensorData

@Program("sparse", parameters = [Parameter("radius", "10.0", "Greatest distance to a leader in metres.")])
fun Aggregate<Int>.sparse(sensors: SensorData, device: Device): ActuatorData = with(device) {
    val leader = boundedElection(parameters.double("radius"), distances())
    ActuatorData(value = distanceTo(leader == localId, metric = distances()), category = leader, flag = leader == localId)
}
