// Collection is the opposite of a gradient: values flow along the gradient to the source, which adds them up. Here
// each node contributes 1, so that the source counts the swarm.
//
// Question: how many seconds pass until the source knows the number of nodes? How does the number depend on message
// loss?

package collection

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.accumulation.countDevices
import org.collektive.api.Program
import standard.ActuatorData
import standard.SensorData

@Program("collection")
fun Aggregate<Int>.collection(sensors: SensorData): ActuatorData = ActuatorData(value = countDevices(sensors.source()).toDouble())
