package probe

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.api.Program

/** In its own jar. */
@Program("triple")
public fun Aggregate<Int>.triple(sensors: SensorData): ActuatorData = ActuatorData(sensors.value() * 3)
