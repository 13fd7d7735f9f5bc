package probe

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.api.Program

/** Returns three times the value. This program is in a separate jar. */
@Program("triple")
public fun Aggregate<Int>.triple(sensors: SensorData): ActuatorData = ActuatorData(sensors.value() * 3)
