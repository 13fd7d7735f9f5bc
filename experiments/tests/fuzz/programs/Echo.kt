package fuzz

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.api.Program

/** Answers with the node's sensor data. */
@Program("echo")
public fun Aggregate<Int>.echo(sensors: SensorData): ActuatorData = ActuatorData(level = sensors.level(), name = "007")
