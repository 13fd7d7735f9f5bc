package gradientascent

import org.collektive.api.Device
import org.collektive.api.Parameters
import org.collektive.engine.Philox
import org.collektive.runtime.AggregateRuntimes
import org.collektive.schema.Vector3Value
import org.collektive.testkit.Network
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals

/** Tests two nodes with values that are calculated by hand. Node 0 at the origin senses 10, and node 1 at (3, 1, 4) senses 20. */
class GradientAscentTest {
    private val network = Network(AggregateRuntimes(), 0, 1)

    private fun round(id: Int, neighbor: Int?, sensors: SensorData, step: String = "1.0"): List<Float> {
        if (neighbor != null) network.linkOneWay(neighbor, id)
        val target = network.round(listOf(id)) { gradientAscent(sensors, device(id, step)) }.getValue(id).target
        return listOf(target.x, target.y, target.z)
    }

    private val low = sensors(10f, Vector3Value(0f, 1f, 0f))
    private val high = sensors(20f, Vector3Value(3f, 1f, 4f))

    @Test
    fun `both nodes climb, including the one in front`() {
        round(0, null, low)
        assertEquals(listOf(3.6f, 1f, 4.8f), round(1, 0, high), "it must move away from the lower node")
        assertEquals(listOf(0.6f, 1f, 0.8f), round(0, 1, low), "it must move towards the higher node")
    }

    @Test
    fun `a node without neighbours and obstacles stays in place`() = assertEquals(listOf(3f, 1f, 4f), round(1, null, high))

    @Test
    fun `the step is the node's parameter`() {
        round(1, null, high)
        assertEquals(listOf(0.3f, 1f, 0.4f), round(0, 1, low, step = "0.5"))
    }

    @Test
    fun `an obstacle repels within a metre only`() {
        assertEquals(listOf(-1f, 1f, 0f), round(0, null, sensors(10f, Vector3Value(0f, 1f, 0f), Vector3Value(0.5f, 0f, 0f))))
        assertEquals(listOf(0f, 1f, 0f), round(0, null, sensors(10f, Vector3Value(0f, 1f, 0f), Vector3Value(1.5f, 0f, 0f))))
    }

    @Test
    fun `pull and push add up`() {
        round(1, null, high)
        // The neighbour pulls by 10 along (0.6, 0.8), and the obstacle pushes by 2 / 0.25 = 8 along -z. The sum is (6, 0).
        assertEquals(listOf(1f, 1f, 0f), round(0, 1, sensors(10f, Vector3Value(0f, 1f, 0f), Vector3Value(0f, 0f, 0.5f))))
    }

    @Test
    fun `a neighbour or an obstacle at the same position has no direction`() {
        round(1, null, sensors(20f, Vector3Value(0f, 1f, 0f)))
        assertEquals(listOf(0f, 1f, 0f), round(0, 1, sensors(10f, Vector3Value(0f, 1f, 0f), Vector3Value(0f, 0f, 0f))))
    }

    private fun device(id: Int, step: String): Device = object : Device {
        override val id = id
        override val time = 0.0
        override val deltaTime = 0.05
        override val random = Philox(1, id, 0)
        override val parameters = Parameters(mapOf("step" to step))
        override val globals: Any? = null
    }
}
