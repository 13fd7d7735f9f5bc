package probe

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.neighborhood
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.stdlib.spreading.hopDistanceTo
import org.collektive.api.Device
import org.collektive.api.Parameter
import org.collektive.api.Program

@Program("double")
public fun Aggregate<Int>.double(sensors: SensorData): ActuatorData = ActuatorData(sensors.value() * 2)

/** Returns 1 for 2, infinity for 0.5 and NaN for 0. */
@Program("ratio")
public fun Aggregate<Int>.ratio(sensors: SensorData): ActuatorData = ActuatorData(sensors.value() / sensors.value().toInt())

@Program("sum")
public fun Aggregate<Int>.sum(sensors: SensorData): ActuatorData {
    val heard = neighboring(sensors.value()).neighbors.list.map { it.value }
    return ActuatorData(heard.sum(), heard.size)
}

/** Returns the number of hops to the nearest node whose value is 0, or -1 while none is known. */
@Program("hops")
public fun Aggregate<Int>.hops(sensors: SensorData): ActuatorData {
    val unknown = Int.MAX_VALUE
    val source = sensors.value() == 0f
    val hops = share(unknown) { field ->
        val nearest = field.neighbors.list.map { it.value }.minOrNull() ?: unknown
        if (source) {
            0
        } else if (nearest == unknown) {
            unknown
        } else {
            nearest + 1
        }
    }
    return ActuatorData(if (hops == unknown) -1f else hops.toFloat())
}

/** Computes the same as "hops" with the standard library. */
@Program("far")
public fun Aggregate<Int>.far(sensors: SensorData): ActuatorData = ActuatorData(hopDistanceTo(sensors.value() == 0f).toFloat())

/** Counts the neighbours in the same branch. The sign of the value selects the branch. */
@Program("arms")
public fun Aggregate<Int>.arms(sensors: SensorData): ActuatorData =
    if (sensors.value() < 0) ActuatorData(-1f, neighboring(0).neighbors.size) else ActuatorData(1f, neighboring(0).neighbors.size)

@Program("count")
public fun Aggregate<Int>.count(sensors: SensorData): ActuatorData = ActuatorData(evolve(0) { it + 1 }.toFloat())

@Program("random")
public fun Aggregate<Int>.random(sensors: SensorData, device: Device): ActuatorData = ActuatorData(device.random.nextDouble().toFloat())

/** Returns the wind of the global data, or -1 before it is set. */
@Program("windy")
public fun Aggregate<Int>.windy(sensors: SensorData, device: Device): ActuatorData =
    ActuatorData((device.globals as GlobalData?)?.wind() ?: -1f)

@Program("clock")
public fun Aggregate<Int>.clock(sensors: SensorData, device: Device): ActuatorData =
    ActuatorData(device.time.toFloat(), (device.deltaTime * 1000).toInt())

@Program("scaled", parameters = [Parameter("factor", "3", "Factor by which the value is multiplied.")])
public fun Aggregate<Int>.scaled(sensors: SensorData, device: Device): ActuatorData =
    ActuatorData(sensors.value() * device.parameters.double("factor").toFloat())

private class Reading(val name: String, val content: Any)

private fun Aggregate<Int>.clash(): Int = share(0) { it.local.value }

private fun Aggregate<Int>.deeper(depth: Int): Int = if (depth < 0) neighboring(depth).local.value else deeper(depth + 1) + 1

private fun Aggregate<Int>.misaligned(all: List<Field<Int, *>>): Int = combined(all, neighboring(1))

/** Combines a field of the current branch with a field of all neighbours, which the plugin does not project to the branch here. */
@CollektiveIgnore("fields in compiled libraries are not projected either")
private fun combined(all: List<Field<Int, *>>, near: Field<Int, Int>): Int = all.single().alignedMap(near) { _, _, b -> b }.local.value

/** Fails in the way that a value of 13 or more selects. With other values, counts rounds like "count". */
@Suppress("AGGREGATE_CALL_IN_LOOP", "CONSTANT_NEIGHBORING")
@Program("trouble")
public fun Aggregate<Int>.trouble(sensors: SensorData): ActuatorData {
    val rounds = evolve(0) { it + 1 }
    val near = listOf(neighborhood())
    when (sensors.value().toInt()) {
        13 -> error("thirteen")
        14 -> while (true) Thread.onSpinWait()
        15 -> recurse(0)
        16 -> System.exit(3)
        17 -> Runtime.getRuntime().halt(3)
        18 -> generateSequence { LongArray(1 shl 26) }.toList()
        19 -> neighboring(sensors)
        20 -> println("a line from the program")
        21 -> for (time in 1..2) clash()
        22 -> deeper(0)
        23 -> misaligned(near)
        24 -> alignedOn(floatArrayOf(1f)) { neighboring(1).local.value }
        25 -> share(sensors.value() to sensors) { it.local.value }
        26 -> share(listOf(Reading("now", sensors))) { it.local.value }
        27 -> neighboring(1)[99]
        28 -> repeat(1000) { println("line $it") }
    }
    return ActuatorData(rounds.toFloat())
}

private fun recurse(depth: Int): Int = if (depth < 0) 0 else recurse(depth + 1) + 1
