package fuzz

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.api.Program

/** Answers what the node senses. */
@Program("echo")
public fun Aggregate<Int>.echo(sensors: SensorData): ActuatorData = ActuatorData(level = sensors.level(), name = "007")
