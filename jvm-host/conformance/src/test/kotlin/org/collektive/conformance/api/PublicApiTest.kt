package org.collektive.conformance.api

import it.unibo.collektive.Collektive
import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.stdlib.ints.FieldedInts
import it.unibo.collektive.stdlib.util.Maybe
import java.io.File
import java.util.zip.GZIPInputStream
import kotlin.reflect.KClass
import kotlin.test.Test
import kotlin.test.assertEquals

/** Sources written for Collektive 28.3 find each of its public declarations here, with the same names, types and defaults. */
class PublicApiTest {
    @Test
    fun `every declaration of the API and the standard library is here, but for the exceptions`() {
        val missing = declared("core") - ours(Field::class, Collektive::class, Maybe::class)
        assertEquals(EXCEPTIONS.keys, missing.groupBy(::exceptionFor).keys, missing.filter { exceptionFor(it) == null }.joinToString("\n"))
    }

    @Test
    fun `the lifted operators are Collektive's, no more and no less`() {
        val theirs = declared("fielded")
        val ours = ours(FieldedInts::class)
        assertEquals(emptySet(), theirs - ours, "missing")
        assertEquals(emptySet(), ours - theirs, "not Collektive's: Plain.kt of the module lifter lists what is not lifted")
    }

    /** The declarations of the modules of [samples]. */
    private fun ours(vararg samples: KClass<*>): Set<String> = Declarations().apply {
        for (sample in samples) read(File(sample.java.protectionDomain.codeSource.location.toURI()))
    }.all()

    /** The key in [EXCEPTIONS] of the declaration [line], which is the class or the function; `null` if there is none. */
    private fun exceptionFor(line: String): String? {
        val (_, owner, name) = line.split('\t')
        return EXCEPTIONS.keys.firstOrNull { it == owner || it == "$owner.$name" }
    }

    private fun declared(table: String): Set<String> {
        val packed = checkNotNull(PublicApiTest::class.java.getResourceAsStream("$table.tsv.gz"))
        return GZIPInputStream(packed).bufferedReader().useLines { lines ->
            lines.filterNot { it.startsWith("#") }.mapTo(LinkedHashSet(), Declarations::normalized)
        }
    }

    private companion object {
        /** What is not here, and why a user does not miss it. */
        val EXCEPTIONS = mapOf(
            "~.networking.OutboundEnvelope.Companion" to "it is empty: there is nothing to call on it",
            "~.path.KotlinCryptoDigest" to "it wraps a class of a library that programs on the JVM do not need: JdkDigest has all digests",
            "~a.Aggregate.InternalAPI" to "internal by its name: the receiver of the two functions below",
            "~a.Aggregate._ serialization aware exchanging" to "internal by its receiver: programs call the extension exchanging",
            "~a.Aggregate._ serialization aware neighboring" to "internal by its receiver: programs call the extension neighboring",
        )
    }
}
