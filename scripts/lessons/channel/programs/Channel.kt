// A channel contains the nodes on shortest paths between a source and a target. On such a path, the distances to
// both ends add up to the distance between the ends, which the source measures and broadcasts.
//
// Question: set the parameter `width` to 2. What shape does the channel have now?

package channel

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.spreading.hopDistanceTo
import it.unibo.collektive.stdlib.spreading.hopGradientCast
import org.collektive.api.Device
import org.collektive.api.Parameter
import org.collektive.api.Program
import standard.ActuatorData
import standard.SensorData

@Program("channel", parameters = [Parameter("width", "0", "Additional hops of a path.")])
fun Aggregate<Int>.channel(sensors: SensorData, device: Device): ActuatorData {
    val isTarget = sensors.sets() and 2L != 0L
    val toSource = hopDistanceTo(sensors.source())
    val toTarget = hopDistanceTo(isTarget)
    val length = hopGradientCast(sensors.source(), toTarget)
    return ActuatorData(
        value = (toSource + toTarget).toDouble(),
        flag =
        length > 0 && toSource + toTarget <= length + device.parameters.int("width"),
    )
}
