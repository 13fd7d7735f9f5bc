package org.collektive.generator

import java.nio.file.Files
import java.nio.file.Path
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse

/** Mistakes of users, and the messages about them. */
internal class RefusalTest {
    @Test
    fun `a schema without one of the two types is refused, and the message lists its types`() {
        assertEquals(
            "user.fbs: there is no SensorData; add `table SensorData { ... }` or `struct SensorData { ... }` (it defines ActuatorData, Sensors)",
            refusal("namespace a; struct Sensors { x: float; } struct ActuatorData { x: float; }"),
        )
        assertContains(refusal("namespace a; struct SensorData { x: float; }"), "there is no ActuatorData")
        assertContains(refusal("namespace a;"), "it defines no types")
    }

    @Test
    fun `a schema without a namespace is refused`() {
        assertContains(
            refusal("struct SensorData { x: float; } struct ActuatorData { x: float; }"),
            "lies in no namespace; write `namespace yours;`",
        )
    }

    @Test
    fun `an unsupported type is refused with its field and an alternative`() {
        assertEquals(
            "user.fbs: SensorData.shape: unions are not supported; use one optional table field for each case",
            refusal(user("table A {} table B {} union Shape { A, B }", "shape: Shape;")),
        )
        assertEquals(
            "user.fbs: SensorData.shapes: unions are not supported; use one optional table field for each case",
            refusal(user("table A {} table B {} union Shape { A, B }", "shapes: [Shape];")),
        )
        assertEquals(
            "user.fbs: Grid.cells: fixed arrays are not supported; use one field for each element, or a vector in a table",
            refusal(user("struct Grid { cells: [float:4]; }", "grid: Grid;")),
        )
        assertContains(refusal(user("", "huge: [ubyte] (vector64);")), "SensorData.huge")
        val many = (0..64).joinToString(" ") { "f$it: int;" }
        assertEquals(
            "user.fbs: Wide: it has 65 fields, more than 64; put some into a table of their own",
            refusal(user("table Wide { $many }", "wide: Wide;")),
        )
        assertEquals(
            "user.fbs: Odd: force_align is not supported; remove it",
            refusal(user("struct Odd (force_align: 16) { x: float; }", "odd: Odd;")),
        )
    }

    @Test
    fun `names that collide with generated code are refused`() {
        for (name in listOf("class", "to_string", "wait", "byte_buffer")) {
            assertEquals(
                "user.fbs: SensorData.$name: C# or Java has a member of this name in every class; rename the field",
                refusal(user("", "$name: int;")),
            )
        }
        assertEquals(
            "user.fbs: DetailValue is a name that the generator gives; rename the type",
            refusal(user("table DetailValue {} table Detail {}", "x: Detail;")),
        )
    }

    @Test
    fun `a root type inside of another type is refused`() {
        assertEquals(
            "user.fbs: Detail.all: SensorData cannot be part of a type; use a type of its own",
            refusal(user("table Detail { all: [SensorData]; }", "x: Detail;")),
        )
        assertEquals(
            "user.fbs: SensorData.last: ActuatorData cannot be part of a type; use a type of its own",
            refusal(user("", "last: ActuatorData;")),
        )
    }

    @Test
    fun `numbers beyond 63 bits are refused, since the binary schema loses them`() {
        assertEquals(
            "user.fbs:2: 9223372036854775808 is too large; numbers go up to 9223372036854775807",
            refusal("namespace a;\ntable SensorData { x: ulong = 9223372036854775808; }\nstruct ActuatorData { x: float; }"),
        )
    }

    @Test
    fun `a global struct is refused`() {
        assertEquals("user.fbs: GlobalData is a struct: make it a table", refusal(user("struct GlobalData { x: float; }", "x: int;")))
    }

    @Test
    fun `two types of one name, or in two namespaces, are refused`() {
        assertContains(
            refusal(
                "namespace a; struct SensorData { x: float; } namespace b; struct SensorData { x: float; } struct ActuatorData { x: float; }",
            ),
            "SensorData is defined twice: a.SensorData and b.SensorData",
        )
        assertContains(
            refusal("namespace a; struct SensorData { x: float; } namespace b; struct ActuatorData { x: float; }"),
            "SensorData lies in namespace a, ActuatorData in b: use one",
        )
    }

    @Test
    fun `flatc's errors are passed on with file and line`() {
        val message = refusal("namespace a;\ntable SensorData { x: flot; }")
        assertContains(message, "user.fbs:2")
        assertContains(message, "flot")
    }

    @Test
    fun `a refused schema leaves no files`() {
        val folder = Workshop.newFolder()
        val schema = Files.writeString(folder.resolve("user.fbs"), user("union U { SensorData }", "u: U;"))
        assertFailsWith<GeneratorException> { Workshop.generate(schema, folder.resolve("out")) }
        assertFalse(Files.exists(folder.resolve("out")))
    }

    @Test
    fun `a command line with a missing or unknown option is refused by name`() {
        val flatc = Workshop.flatc.toString()
        val schema = Workshop.testSchemas.resolve("blocks.fbs").toString()
        fun message(vararg words: String) = assertFailsWith<GeneratorException> { Arguments.parse(arrayOf(*words)) }.message.orEmpty()
        assertContains(message(), "--flatc is missing")
        assertContains(message("--flatc", flatc, "--schema"), "--schema needs a value")
        assertContains(message("--colour", "red"), "unknown option --colour")
        assertContains(message("--flatc", flatc, "--flatc", flatc), "--flatc is given twice")
        assertContains(message("--flatc", "nothing", "--schema", schema, "--include", "x"), "no flatc at nothing: run ./collektive setup")
        assertContains(message("--flatc", flatc, "--schema", "nothing.fbs", "--include", "x"), "no schema file at nothing.fbs")
        assertContains(message("--flatc", flatc, "--schema", schema, "--include", "x"), "no types.fbs in x")
    }

    private fun user(before: String, fields: String) = "namespace a; $before table SensorData { $fields } struct ActuatorData { x: float; }"

    private fun refusal(text: String): String = assertFailsWith<GeneratorException> { Workshop.generate(text) }.message.orEmpty()
}
