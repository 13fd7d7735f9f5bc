// A gradient is the distance of each node to the nearest source. A node only knows the distances of its neighbours:
// it takes the smallest one and adds one hop. After as many rounds as the longest path has hops, all distances are
// correct.
//
// Question: replace hopDistanceTo(...) by distanceTo(..., metric = distances()) inside with(device). Which values
// change, and why?

package gradient

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.spreading.hopDistanceTo
import org.collektive.api.Program
import standard.ActuatorData
import standard.SensorData

@Program("gradient")
fun Aggregate<Int>.gradient(sensors: SensorData): ActuatorData = ActuatorData(value = hopDistanceTo(sensors.source()).toDouble())
