// A flock has no leader. Each node starts in a random direction, then takes the mean direction of its neighbours,
// and keeps away from those that are too close. After some seconds all move in the same direction.
//
// Question: remove the loop that keeps nodes apart. What happens to the flock?

package flocking

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.aggregate.values
import org.collektive.api.Device
import org.collektive.api.Program
import org.collektive.schema.Vector3Value
import standard.ActuatorData
import standard.SensorData
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin

private const val SPEED = 1.5
private const val APART = 2.0

@Program("flocking")
fun Aggregate<Int>.flocking(sensors: SensorData, device: Device): ActuatorData {
    val here = sensors.position().x().toDouble() to sensors.position().z().toDouble()
    val angle = device.random.nextDouble() * 2 * Math.PI
    val direction = share(cos(angle) to sin(angle)) { directions ->
        var x: Double = directions.all.values.list.sumOf { it.first }
        var z: Double = directions.all.values.list.sumOf { it.second }
        for (there in neighboring(here).neighbors.values.list) {
            val distance = hypot(here.first - there.first, here.second - there.second)
            if (distance < APART && distance > 0) {
                x += (here.first - there.first) / distance
                z += (here.second - there.second) / distance
            }
        }
        val length = hypot(x, z)
        if (length > 0) x / length to z / length else directions.local.value
    }
    val velocity = Vector3Value((SPEED * direction.first).toFloat(), 0f, (SPEED * direction.second).toFloat())
    return ActuatorData(value = Math.toDegrees(Math.atan2(direction.second, direction.first)), velocity = velocity)
}
