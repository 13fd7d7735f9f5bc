// Gossip finds the greatest reading in the swarm. Node 0 reads 100 degrees until second 5, all others 20. A simple
// gossip never forgets the 100. The gossip of the library forwards values with their path, so it detects when the
// source of a value has gone.
//
// Question: the category shows the simple gossip. Which of the two would you use for an alarm, and which for a
// record of the past?

package gossip

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.spreading.gossipMax
import it.unibo.collektive.stdlib.spreading.nonStabilizingGossip
import org.collektive.api.Program
import standard.ActuatorData
import standard.SensorData

@Program("gossip")
fun Aggregate<Int>.gossip(sensors: SensorData): ActuatorData = ActuatorData(
    value = gossipMax(sensors.reading()),
    category = nonStabilizingGossip(sensors.reading()) { a, b -> maxOf(a, b) }.toInt(),
)
