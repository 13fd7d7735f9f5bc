package template

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.spreading.distanceTo
import org.collektive.api.Device
import org.collektive.api.Program
import org.collektive.links.distances

/** The distance to the nearest source along links. */
@Program("distance")
fun Aggregate<Int>.distance(sensors: SensorData, device: Device): ActuatorData =
    ActuatorData(distance = distanceFrom(sensors.source(), device).toFloat())

/** [distance] without sensor data, for tests. */
internal fun Aggregate<Int>.distanceFrom(source: Boolean, device: Device): Double = with(device) {
    distanceTo(source, metric = distances()).takeIf(Double::isFinite) ?: -1.0
}
