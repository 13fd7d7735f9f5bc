package lamps

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.share
import org.collektive.api.Program

/** Spreads the greatest brightness of all lamps by gossip. */
@Program("brightest")
public fun Aggregate<Int>.brightest(sensors: SensorData): ActuatorData {
    val mine = sensors.brightness()
    val heard = mutableListOf<Int>()
    val best = share(mine) { field ->
        val values = field.neighbors.list
        heard += values.map { it.id }
        maxOf(mine, values.maxOfOrNull { it.value } ?: mine)
    }
    return ActuatorData(brightest = best, seen = heard.toIntArray())
}
