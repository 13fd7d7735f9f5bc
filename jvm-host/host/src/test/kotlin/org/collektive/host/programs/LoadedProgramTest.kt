package org.collektive.host.programs

import org.collektive.api.Parameter
import org.collektive.api.Program
import org.collektive.host.shim.HostException
import org.junit.jupiter.api.Test
import java.lang.invoke.MethodHandles
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

class LoadedProgramTest {
    private enum class Shape { RING, LINE }

    private val program =
        program(Parameter("speed", "1.5", "m/s"), Parameter("mode", "fast", ""), Parameter("shape", "RING", values = Shape::class))

    private fun program(vararg parameters: Parameter) = LoadedProgram(
        Program("steer", parameters = arrayOf(*parameters)),
        MethodHandles.empty(LoadedProgram.TYPE),
        "steer.SteerKt.steer",
        javaClass.classLoader,
    )

    @Test
    fun `a value must be a number if its default is one`() {
        val refused = assertFailsWith<HostException> { program.parameters(3, mapOf("speed" to "quick")) }
        assertEquals(
            "node 3 sets the parameter 'speed' of program 'steer' to 'quick': it must be a number like its default 1.5",
            refused.message,
        )
        assertEquals(2.0, program.parameters(3, mapOf("speed" to "2", "mode" to "slow")).double("speed"))
    }

    @Test
    fun `a value and the default must be constants of the parameter's enum class`() {
        val refused = assertFailsWith<HostException> { program.parameters(3, mapOf("shape" to "CUBE")) }
        assertEquals("node 3 sets the parameter 'shape' of program 'steer' to 'CUBE': it must be one of [RING, LINE]", refused.message)
        assertEquals(Shape.LINE, program.parameters(3, mapOf("shape" to "LINE")).enum<Shape>("shape"))
        val misdeclared = assertFailsWith<HostException> { program(Parameter("shape", "ring", values = Shape::class)) }
        assertEquals("program 'steer': the default of the parameter 'shape' is 'ring': it must be one of [RING, LINE]", misdeclared.message)
    }

    @Test
    fun `a full heap names the setting to raise`() {
        val description = program.describe(OutOfMemoryError("Java heap space"), "node 1 at root")
        assertContains(
            description,
            "java.lang.OutOfMemoryError: Java heap space, with all ${Runtime.getRuntime().maxMemory() shr 20} MB in use: raise the maximum heap",
        )
        assertContains(description, "jvm.maximumHeapMb")
        assertContains(program.describe(OutOfMemoryError("Metaspace"), null), "-XX:MaxMetaspaceSize")
        assertContains(
            program.describe(OutOfMemoryError("Cannot reserve 4 bytes of direct buffer memory"), null),
            "-XX:MaxDirectMemorySize",
        )
    }
}
