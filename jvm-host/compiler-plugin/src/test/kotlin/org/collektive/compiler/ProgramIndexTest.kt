package org.collektive.compiler

import kotlin.test.Test
import kotlin.test.assertEquals

/** Tests the index of a module's programs and their parameters, which is written beside its classes. */
class ProgramIndexTest {
    @Test
    fun `programs are listed with their sensor data, parameters, defaults, descriptions and constants`() {
        val index = Compilation.of(
            """
            package swarm
            import org.collektive.api.Parameter
            import org.collektive.api.Program
            class SensorData
            const val SPEED = "speed"
            @Program("hops", parameters = [Parameter("bright", "90", "Intensity of a source."), Parameter(default = "1.5", name = SPEED)])
            fun Aggregate<Int>.hops(sensors: SensorData): Int = localId
            fun Aggregate<Int>.helper(sensors: SensorData): Int = localId
            enum class Shape { RING, LINE; fun next() = LINE }
            @Program("plain", parameters = [Parameter("shape", "RING", values = Shape::class)])
            fun Aggregate<Int>.plain(sensors: SensorData): Int = localId
            """,
        ).output("META-INF/collektive/programs/swarm.ProgramKt")
        assertEquals(
            """
            program	hops	swarm.SensorData
            parameter	bright	90	Intensity of a source.
            parameter	speed	1.5	
            program	plain	swarm.SensorData
            parameter	shape	RING		RING	LINE

            """.trimIndent(),
            index,
        )
    }

    @Test
    fun `the index has the name of the class`() {
        val source = """
            @file:JvmName("Swarm")
            import org.collektive.api.Program
            @Program("hops")
            fun Aggregate<Int>.hops(sensors: Int): Int = localId
            """
        assertEquals("program\thops\tkotlin.Int\n", Compilation.of(source).output("META-INF/collektive/programs/Swarm"))
    }

    @Test
    fun `tabs, line feeds and backslashes are escaped`() {
        val source = """
            import org.collektive.api.*
            @Program("hops", [Parameter("a", "b\tc\\d", "e\nf\r")])
            fun Aggregate<Int>.hops(sensors: Int): Int = localId
            """
        assertEquals(
            "program\thops\tkotlin.Int\nparameter\ta\tb\\tc\\\\d\te\\nf\\r\n",
            Compilation.of(source).output("META-INF/collektive/programs/ProgramKt"),
        )
    }

    @Test
    fun `files without programs have no index`() {
        assertEquals(null, Compilation.of("fun Aggregate<Int>.hops(): Int = localId").output("META-INF/collektive/programs/ProgramKt"))
    }
}
