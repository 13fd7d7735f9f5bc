package template

import org.collektive.testing.TestNetwork
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals

class TemplateTest {
    @Test
    fun `the distance is the length of the shortest path, and -1 without a path`() = TestNetwork().use { network ->
        network.add(0, 1, 2, 3)
        network.link(0, 1, length = 2.5)
        network.link(1, 2, length = 3.0)
        val answers = network.rounds(4) { device -> distanceFrom(localId == 0, device) }
        assertEquals(mapOf(0 to 0.0, 1 to 2.5, 2 to 5.5, 3 to -1.0), answers)
    }
}
