package org.collektive.generator

import java.nio.file.Files
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals

internal class FingerprintTest {
    @Test
    fun `the hash is FNV-1a of 64 bits`() {
        assertEquals(0xcbf29ce484222325uL, Fingerprint.hash("").toULong())
        assertEquals(0xaf63dc4c8601ec8cuL, Fingerprint.hash("a").toULong())
        assertEquals(0x85944171f73967e8uL, Fingerprint.hash("foobar").toULong())
    }

    @Test
    fun `the text contains nested types inline, and a recursive table as a distance`() {
        val schema =
            read(
                "struct P { x: float; on: bool; } enum E : ubyte { A, B = 4 } table N { next: N; all: [N]; }",
                "p: P; e: E = B; n: N; s: string (required); o: int = null;",
            )
        assertEquals(
            "table{0 p:struct 8{0 x:float;4 on:bool;};1 e:enum ubyte{A=0,B=4}=4;2 n:table{0 next:^0;1 all:[^0];};3 s:string required;4 o:int=null;}",
            Fingerprint.text(schema.sensor),
        )
    }

    @Test
    fun `the text of a real default is the same on all JDKs`() {
        val schema = read("", "a: float = 0.1; b: double = 2.0e-3; c: double; d: double = inf;")
        val reals = listOf("0 a:float=0x1.999999999999ap-4", "1 b:double=0x1.0624dd2f1a9fcp-9", "2 c:double=0x0.0p0", "3 d:double=Infinity")
        assertEquals("table{${reals.joinToString("") { "$it;" }}}", Fingerprint.text(schema.sensor))
    }

    @Test
    fun `every change of bytes or names changes the fingerprint`() {
        val base = fingerprint("a: float; b: int;")
        val changes = listOf(
            "b: int; a: float;", "a: float; c: int;", "a: double; b: int;", "a: float = 1; b: int;", "a: float; b: int = null;",
            "a: float; b: int; c: int;", "a: [float]; b: int;", "a: float; b: uint;", "a: float (deprecated); b: int;",
        )
        for (change in changes) assertNotEquals(base, fingerprint(change), change)
    }

    @Test
    fun `comments and spaces do not change the fingerprint`() {
        assertEquals(fingerprint("a: float; b: int;"), fingerprint("\n/// says more\n a:float;\n\n b : int ; // end\n"))
    }

    private fun fingerprint(fields: String) = Fingerprint.of(read("", fields).sensor)

    private fun read(before: String, fields: String): UserSchema {
        val folder = Fixture.newFolder()
        val file = Files.writeString(
            folder.resolve("user.fbs"),
            "namespace a; $before table SensorData { $fields } struct ActuatorData { x: float; }",
        )
        Flatc(Fixture.flatc, emptyList()).fullBinarySchema(file, folder)
        return SchemaReader(Files.readAllBytes(folder.resolve("user.bfbs")), file, folder.resolve(CORE_TYPES)).read()
    }
}
