// An election without a centre: each node proposes itself, and forwards the best candidate that it has received.
// Here the greatest id wins.
//
// Question: the leader leaves if you remove node 99 in live. Do the others detect this? Read the documentation of
// globalElection, then try boundedElection(20).

package leader

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.consensus.globalElection
import org.collektive.api.Program
import standard.ActuatorData
import standard.SensorData

@Program("leader")
fun Aggregate<Int>.leader(sensors: SensorData): ActuatorData {
    val leader = globalElection()
    return ActuatorData(value = leader.toDouble(), category = leader, flag = leader == localId)
}
