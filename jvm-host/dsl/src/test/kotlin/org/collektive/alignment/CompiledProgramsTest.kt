package org.collektive.alignment

import it.unibo.collektive.aggregate.FakeDevice
import it.unibo.collektive.aggregate.toMap
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertNull
import kotlin.test.assertSame

/** Tests the functions that compiled programs call, on a device that does not implement [AlignmentStack]. */
class CompiledProgramsTest {
    @Test
    fun `tokens are pivots of the device's own stack`() {
        val device = FakeDevice(1)
        val outer = pushToken(device, "outer")
        val inner = pushToken(device, "inner")
        assertEquals(listOf<Any?>("outer", "inner"), device.path)
        popToken(device, inner)
        popToken(device, outer)
        assertEquals(emptyList(), device.path)
    }

    @Test
    fun `code without a device has no stack`() = popToken(null, pushToken(null, "outer"))

    @Test
    fun `a projected field contains the devices that are aligned at the token`() {
        val device = FakeDevice(1, aligned = listOf(3, 4))
        val field = device.field(listOf(2, 3, 4), listOf(20, 30, 40), local = 10)
        assertEquals(mapOf(3 to 30, 4 to 40, 1 to 10), project(field, "branch", true)?.all?.toMap())
        assertEquals(emptyList(), device.path)
    }

    @Test
    fun `a field whose devices are all aligned is not copied`() {
        val device = FakeDevice(1, aligned = listOf(2, 3))
        val field = device.field(listOf(2, 3), listOf(20, 30), local = 10)
        assertSame(field, project(field, "branch", true))
        assertNull(project<Int, Int>(null, "branch", true))
    }
}
