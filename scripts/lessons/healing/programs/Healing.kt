// Aggregate programs heal themselves. At second 5 the source moves to the opposite corner. The nodes are not
// informed. Their distances become correct again within a few rounds, because each round computes them again from
// the neighbours' messages.
//
// Question: which nodes are correct first? Remove nodes in live, and watch the distances around the gap.

package healing

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.spreading.hopDistanceTo
import org.collektive.api.Program
import standard.ActuatorData
import standard.SensorData

@Program("healing")
fun Aggregate<Int>.healing(sensors: SensorData): ActuatorData = ActuatorData(value = hopDistanceTo(sensors.sets() != 0L).toDouble())
