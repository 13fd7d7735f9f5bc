package org.collektive.conformance.api

import it.unibo.collektive.Collektive
import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.stdlib.util.Maybe
import java.io.File
import java.io.InputStream
import java.util.zip.GZIPInputStream
import kotlin.reflect.KClass
import kotlin.test.Test
import kotlin.test.assertEquals

/** Compares the public declarations of `dsl`, `runtime` and `stdlib` with those of Collektive 28.3: names, types and defaults. */
class PublicApiTest {
    private val ours = ours(Field::class, Collektive::class, Maybe::class)

    @Test
    fun `every declaration of the API and the standard library exists, except for the listed exceptions`() {
        val missing = declared("core") - ours
        assertEquals(EXCEPTIONS.keys, missing.groupBy(::exceptionFor).keys, missing.filter { exceptionFor(it) == null }.joinToString("\n"))
    }

    @Test
    fun `every lifted operator exists`() = assertEquals(emptySet(), declared("fielded") - ours)

    @Test
    fun `declarations that Collektive does not have are in additions tsv`() {
        val additions = ours - declared("core") - declared("fielded")
        assertEquals(resource("additions.tsv").use(::lines).sorted().joinToString("\n"), additions.sorted().joinToString("\n"))
    }

    /** Returns the public declarations of the modules that contain [samples], without the runtime's implementation. */
    private fun ours(vararg samples: KClass<*>): Set<String> = Declarations().apply {
        for (sample in samples) read(File(sample.java.protectionDomain.codeSource.location.toURI()))
    }.all().filterNotTo(LinkedHashSet()) { it.split('\t')[1].startsWith("org.collektive.runtime") }

    /** Returns the key of [EXCEPTIONS] (a class or a function) that covers the declaration [line], or `null`. */
    private fun exceptionFor(line: String): String? {
        val (_, owner, name) = line.split('\t')
        return EXCEPTIONS.keys.firstOrNull { it == owner || it == "$owner.$name" }
    }

    private fun declared(table: String): Set<String> =
        GZIPInputStream(resource("$table.tsv.gz")).use(::lines).mapTo(LinkedHashSet(), Declarations::normalized)

    private fun resource(name: String): InputStream = checkNotNull(PublicApiTest::class.java.getResourceAsStream(name))

    private fun lines(table: InputStream): List<String> = table.bufferedReader().readLines().filterNot { it.startsWith("#") }

    private companion object {
        /** The declarations that are missing on purpose, and the reason for each. */
        val EXCEPTIONS = mapOf(
            "~.networking.OutboundEnvelope.Companion" to "it is empty, so programs cannot call it",
            "~.path.KotlinCryptoDigest" to "it wraps a library class that JVM programs do not need: JdkDigest has all digests",
            "~a.Aggregate.InternalAPI" to "its name marks it as internal: it is the receiver of the two functions below",
            "~a.Aggregate._ serialization aware exchanging" to "internal by its receiver: programs call the extension exchanging",
            "~a.Aggregate._ serialization aware neighboring" to "internal by its receiver: programs call the extension neighboring",
        )
    }
}
