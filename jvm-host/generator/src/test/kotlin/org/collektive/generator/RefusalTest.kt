package org.collektive.generator

import org.junit.jupiter.api.io.TempDir
import java.io.ByteArrayOutputStream
import java.io.PrintStream
import java.nio.file.Files
import java.nio.file.Path
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Tests the messages about errors in schemas. */
internal class RefusalTest {
    @Test
    fun `warnings about the style of names are removed with their heading`() {
        val style = "  /a.fbs:1: 37: warning: field names should be lowercase snake_case, got: fooBar\n"
        assertEquals("", Flatc.withoutStyle("\nwarning:\n$style\n"))
        assertEquals("error:\n/a.fbs:1: 96: error: why", Flatc.withoutStyle("\nerror:\n$style/a.fbs:1: 96: error: why\n"))
    }

    @Test
    fun `a schema without one of the two types is refused, and the message lists its types`() {
        assertEquals(
            "user.fbs:1: SensorData is missing; add `table SensorData { ... }` or `struct SensorData { ... }` (it defines ActuatorData, Sensors)",
            refusal("namespace a; struct Sensors { x: float; } struct ActuatorData { x: float; }"),
        )
        assertContains(refusal("namespace a; struct SensorData { x: float; }"), "ActuatorData is missing")
        assertContains(refusal("namespace a;"), "it defines no types")
    }

    @Test
    fun `Java files among programs are refused`(@TempDir folder: Path) {
        Files.createFile(folder.resolve("Helper.java"))
        val log = ByteArrayOutputStream()
        val words = listOf("--jar", "$folder/a.jar", "--work", "$folder/work", "--source", "$folder")
        assertEquals(1, ProgramCompiler.compile(words, PrintStream(log)))
        assertContains("$log", "Helper.java: only Kotlin is compiled")
    }

    @Test
    fun `an error of flatc begins with its position`() {
        val unknown = refusal("namespace a;\ntable SensorData {\n  x: flaot;\n}\n\n\n").lines()
        assertEquals("flatc rejects user.fbs:", unknown[0])
        assertTrue(unknown[1].matches(Regex("""/.*/user\.fbs:3: error: type referenced but not defined .*: flaot""")), unknown[1])
        val cut = refusal("namespace a;\nstruct SensorData {").lines()
        assertTrue(cut[1].matches(Regex("""/.*/user\.fbs:2(:\d+)?: error: expecting: identifier .*""")), cut[1])
    }

    @Test
    fun `a schema without a namespace is refused`() {
        assertContains(
            refusal("struct SensorData { x: float; } struct ActuatorData { x: float; }"),
            "it has no namespace; write `namespace NAME;`",
        )
    }

    @Test
    fun `a default of -0 is refused, because the binary schema contains 0`() {
        for (zero in listOf("-0", "-0.0", "-.0", "-0e3")) {
            assertEquals("user.fbs:1: the default $zero is not supported; use 0", refusal(user("", "x: float = $zero;")))
        }
        for (default in listOf("-0.5", "-.5", "-1", "-0x1p1")) Fixture.generate(user("", "x: float = $default;"))
    }

    @Test
    fun `an unsupported type is refused with its field and an alternative`() {
        assertEquals(
            "user.fbs:1: SensorData.shape: unions are not supported; use one optional table field for each case",
            refusal(user("table A {} table B {} union Shape { A, B }", "shape: Shape;")),
        )
        assertEquals(
            "user.fbs:1: SensorData.shapes: unions are not supported; use one optional table field for each case",
            refusal(user("table A {} table B {} union Shape { A, B }", "shapes: [Shape];")),
        )
        assertEquals(
            "user.fbs:1: Grid.cells: fixed arrays are not supported; use one field for each element, or a vector in a table",
            refusal(user("struct Grid { cells: [float:4]; }", "grid: Grid;")),
        )
        assertContains(refusal(user("", "huge: [ubyte] (vector64);")), "SensorData.huge")
        val many = (0..64).joinToString(" ") { "f$it: int;" }
        assertEquals(
            "user.fbs:1: Wide: it has 65 fields, more than 64; move some of them to another table",
            refusal(user("table Wide { $many }", "wide: Wide;")),
        )
        assertEquals(
            "user.fbs:1: Own: private types are not supported; remove the attribute",
            refusal(user("struct Own (private) { x: float; }", "own: Own;")),
        )
        assertEquals(
            "user.fbs:1: Odd: force_align is not supported; remove it",
            refusal(user("struct Odd (force_align: 16) { x: float; }", "odd: Odd;")),
        )
        assertEquals(
            "user.fbs:1: Item.id: key is not supported, because lists are not sorted; remove it",
            refusal(user("table Item { id: uint (key); }", "items: [Item];")),
        )
        assertEquals(
            "user.fbs:1: Bits.B: the value is too large; the maximum is 9223372036854775807, or bit 62",
            refusal(user("enum Bits : ulong (bit_flags) { A, B = 63 }", "bits: Bits;")),
        )
    }

    @Test
    fun `names that collide with generated code are refused`() {
        for (name in listOf("class", "to_string", "wait", "byte_buffer")) {
            assertEquals(
                "user.fbs:1: SensorData.$name: C# or Java has a member of this name in every class; rename the field",
                refusal(user("", "$name: int;")),
            )
        }
        assertEquals(
            "user.fbs:1: DetailValue: the generator uses this name; rename the type",
            refusal(user("table DetailValue {} table Detail {}", "x: Detail;")),
        )
    }

    @Test
    fun `a name with another meaning in generated code is refused with its line`() {
        fun type(declaration: String) = "namespace a;\n\n$declaration\ntable SensorData { x: int; }\nstruct ActuatorData { x: float; }"
        fun fields(text: String) = "namespace a;\nstruct ActuatorData { x: float; }\ntable SensorData {\n$text\n}"
        fun namespace(name: String) = "namespace $name;\ntable SensorData { x: int; }\nstruct ActuatorData { x: float; }"
        val refusals = mapOf(
            type("table Table { y: int; }") to "user.fbs:3: Table: generated code uses a type of this name; rename the type",
            type("struct String { y: int; }") to "user.fbs:3: String: generated code uses",
            type("enum Int : byte { A }") to "user.fbs:3: Int: generated code uses",
            type("table when {}") to "user.fbs:3: when: generated code uses",
            type("table _ {}") to "user.fbs:3: _: a name must contain a letter",
            type("table Foo {}\ntable foo {}") to "foo: its name is too similar to that of a.Foo; rename one of them",
            type("table Detail {}\ntable b {}\nnamespace a.b;\nenum E : byte { A }\nnamespace a;") to
                "user.fbs:4: b: a namespace has the same name",
            type("enum E : byte { names }") to "user.fbs:3: E.names: generated code has a member of this name",
            type("enum E : byte { null }") to "user.fbs:3: E.null: flatc cannot use the literal 'null' as a name in Java; rename it",
            fields("true: int;") to "user.fbs:4: SensorData.true: flatc cannot use the literal 'true'",
            fields("_: int;") to "user.fbs:4: SensorData._: a name must contain a letter",
            fields("__assign: int;") to "user.fbs:4: SensorData.__assign: a name must begin with a letter",
            fields("_1: int;") to "user.fbs:4: SensorData._1: a name must begin with a letter",
            fields("foo_bar: int;\nfooBar: int;") to
                "user.fbs:5: SensorData.fooBar: this field and foo_bar are both named FooBar in generated code; rename",
            fields("xs: [int];\nxs_as_byte_buffer: int;") to
                "user.fbs:5: SensorData.xs_as_byte_buffer: code generated for xs has a member of this name",
            fields("builder: int;") to "user.fbs:4: SensorData.builder: code generated for SensorData has a member of this name",
            fields("xs: string;\nxs_offset: int;") to "user.fbs:5: SensorData.xs_offset: code generated for xs has a member of this name",
            fields("a: int;\u0000") to "user.fbs:4: the file contains a NUL character",
            fields("add_y: int;\ny: int;") to "user.fbs:4: SensorData.add_y: code generated for y has",
            namespace("a.class.b") to "user.fbs:3: ActuatorData: the namespace uses the keyword 'class'",
            namespace("a.fun") to "the namespace uses the keyword 'fun'; rename the namespace",
            namespace("String.inner") to "generated code uses a type named String; rename the namespace",
            namespace("java.util") to "the namespace java.util is used by a library or by generated code",
            namespace("kotlin") to "the namespace kotlin is used by a library",
            namespace("org.collektive.frames") to "the namespace org.collektive.frames is used by a library",
            namespace("data") to "the namespace data is used by a library or by generated code",
            fields("table: int;") to "user.fbs:4: SensorData.table: C# or Java has a member of this name",
            type("struct SensorDataVerify { y: int; }") to
                "user.fbs:3: SensorDataVerify: code generated for a.SensorData has a class of this name; rename one of them",
            type("struct a { y: int; }") to "user.fbs:3: a: in generated code it hides the namespace a; rename one of them",
            namespace("SensorData.inner") to "SensorData: in generated code it hides the namespace SensorData",
            namespace("swarm.inner.swarm") to "in C#, the inner namespace swarm hides the root namespace swarm; rename one of them",
            "include \"types.fbs\";\n" + namespace("swarm.org") to "in C#, the inner namespace org hides the root namespace org",
            namespace("Big").replace("x: int", "big: int") to "user.fbs:2: SensorData.big: in C# it hides the namespace Big",
            type("struct C { z: int; }\nstruct B { is: C; }\nstruct A { b: B; }") to
                "user.fbs:4: B.is: C# cannot use this name where the struct is nested; rename the field",
            type("table ${"L".repeat(101)} {}") to "the name has more than 100 characters",
            type("") + "\nroot_type SensorData;\nfile_identifier \"\\\"+x+\";" to
                "user.fbs:1: the file_identifier may contain only ASCII letters and digits",
        )
        for ((schema, message) in refusals) assertContains(refusal(schema), message, message = schema)
    }

    @Test
    fun `a file name that is not a valid class name is refused`() {
        for (name in listOf("1st.fbs", "_.fbs", "sch\u00f6n.fbs", "a\nb.fbs", "a*b.fbs")) {
            val message = assertFailsWith<GeneratorException> { Fixture.generate(user("", "x: int;"), name) }.message.orEmpty()
            assertContains(message, "the file name becomes a class name: begin it with a letter")
        }
    }

    @Test
    fun `a file in another encoding is refused`() {
        val schema = Fixture.newFolder().resolve("user.fbs")
        Files.write(schema, "// Gr\u00f6\u00dfe\n${user("", "x: int;")}".toByteArray(Charsets.ISO_8859_1))
        val message = assertFailsWith<GeneratorException> { Fixture.generate(schema, schema.resolveSibling("out")) }.message.orEmpty()
        assertEquals("user.fbs:1: the file is not in UTF-8; save it with that encoding", message)
    }

    @Test
    fun `types nested too deep or with too many fields are refused`() {
        fun chain(tables: Int) = (0 until tables).joinToString("\n") { "table T$it { next: T${it + 1}; }" } + "\ntable T$tables { x: int; }"
        val deep = "more than 64 levels deep"
        assertContains(refusal(user(chain(3000), "first: T0;")), deep)
        assertContains(refusal(user(chain(64), "first: T0;")), deep)
        Fixture.generate(user(chain(60), "first: T0;"))
        val doubling = (0 until 30).joinToString("\n") { "table T$it { a: T${it + 1}; b: T${it + 1}; }" } + "\ntable T30 { x: int; }"
        assertContains(refusal(user(doubling, "first: T0;")), "its nested types expand to more than 20000 fields")
        val ring = (0 until 30).joinToString("\n") { i -> "table T$i { ${(0 until 30).joinToString(" ") { "f$it: T$it;" }} }" }
        assertContains(refusal(user(ring, "first: T0;")), "expand to more than 20000 fields")
        val wide = (0 until 60).joinToString("\n") { i -> "table T$i { ${(0 until 60).joinToString(" ") { "f$it: int;" }} }" }
        val all = (0 until 60).joinToString(" ") { "t$it: T$it;" }
        assertContains(refusal(user(wide, all)), "its tables have 3660 fields, more than 3000")
        val numbers = (0 until 200).joinToString(" ") { "f$it: long;" }
        val tooBig = refusal(user("struct Big { $numbers }", "big: Big;"))
        assertContains(tooBig, "Big: its fields need more than 240 parameters in generated code")
    }

    @Test
    fun `a root type inside of another type is refused`() {
        assertEquals(
            "user.fbs:1: Detail.all: SensorData cannot be nested in another type; use a separate type",
            refusal(user("table Detail { all: [SensorData]; }", "x: Detail;")),
        )
        assertEquals(
            "user.fbs:1: SensorData.last: ActuatorData cannot be nested in another type; use a separate type",
            refusal(user("", "last: ActuatorData;")),
        )
    }

    @Test
    fun `numbers beyond 63 bits are refused, since the binary schema loses them`() {
        assertEquals(
            "user.fbs:2: 9223372036854775808 is too large; the maximum is 9223372036854775807",
            refusal("namespace a;\ntable SensorData { x: ulong = 9223372036854775808; }\nstruct ActuatorData { x: float; }"),
        )
    }

    @Test
    fun `a global struct is refused`() {
        assertEquals("user.fbs:1: GlobalData: it must be a table", refusal(user("struct GlobalData { x: float; }", "x: int;")))
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
            "SensorData is in namespace a, ActuatorData in b; use one for both",
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
        val folder = Fixture.newFolder()
        val schema = Files.writeString(folder.resolve("user.fbs"), user("union U { SensorData }", "u: U;"))
        assertFailsWith<GeneratorException> { Fixture.generate(schema, folder.resolve("out")) }
        assertFalse(Files.exists(folder.resolve("out")))
    }

    @Test
    fun `a command line with a missing or unknown option is refused by name`() {
        val flatc = Fixture.flatc.toString()
        val schema = Fixture.testSchemas.resolve("blocks.fbs").toString()
        fun message(vararg words: String) = assertFailsWith<GeneratorException> { Arguments.parse(arrayOf(*words)) }.message.orEmpty()
        assertContains(message(), "--flatc is missing")
        assertContains(message("--flatc", flatc, "--schema"), "--schema needs a value")
        assertContains(message("--colour", "red"), "unknown option --colour")
        assertContains(message("--flatc", flatc, "--flatc", flatc), "--flatc is used twice")
        assertContains(message("--flatc", "nothing", "--schema", schema, "--include", "x"), "no flatc at nothing: run ./collektive setup")
        assertContains(message("--flatc", flatc, "--schema", "nothing.fbs", "--include", "x"), "schema not found: nothing.fbs")
        assertContains(message("--flatc", flatc, "--schema", schema, "--include", "x"), "no types.fbs in x")
    }

    @Test
    fun `a command line can name several schemas, and each must exist`() {
        val (first, second) = Fixture.files(Fixture.testSchemas).filter { it.toString().endsWith(".fbs") }
        val include = Fixture.root.resolve("schema").toString()
        val words = arrayOf("--flatc", "${Fixture.flatc}", "--include", include, "--schema", "$first", "--schema")
        assertEquals(listOf(first, second), Arguments.parse(words + "$second").schemas)
        val failure = assertFailsWith<GeneratorException> { Arguments.parse(words + "gone.fbs") }
        assertContains(failure.message.orEmpty(), "schema not found: gone.fbs")
    }

    private fun user(before: String, fields: String) = "namespace a; $before table SensorData { $fields } struct ActuatorData { x: float; }"

    private fun refusal(text: String): String = assertFailsWith<GeneratorException> { Fixture.generate(text) }.message.orEmpty()
}
