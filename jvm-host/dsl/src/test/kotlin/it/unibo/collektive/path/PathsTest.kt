package it.unibo.collektive.path

import kotlinx.serialization.json.Json
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals

/** Tests that equal tokens give equal paths, and different tokens give different paths, with every factory. */
class PathsTest {
    private data class Key(val name: String, val number: Int)

    private val factories = listOf(FullPathFactory, DigestHashingFactory())

    @Test
    fun `equal tokens give equal paths`() {
        for (tokens in listOf(listOf(), listOf("a", 1, null), listOf(Key("a", 1)), listOf(listOf(1, 2), 3L))) {
            for (paths in factories) assertEquals(paths(tokens.toList()), paths(*tokens.toTypedArray()), "$tokens")
        }
        for (paths in factories) assertEquals(paths(Key("a", 1)), paths(Key("a", 1)))
    }

    @Test
    fun `paths differ by the borders, the order and the classes of their tokens`() {
        val others = listOf(
            listOf("ab", "c"), listOf("a", "bc"), listOf("abc"), listOf("c", "ab"), listOf("a", "b", "c"), listOf(),
            listOf(1), listOf(1L), listOf("1"), listOf(null), listOf("null"), listOf(""), listOf("", ""),
            listOf(Key("a", 1)), listOf("Key(name=a, number=1)"), listOf(listOf("a", "b")), listOf("[a, b]"),
            listOf("ajava.lang.String b"), listOf("a", "b"),
        )
        for (paths in factories) assertEquals(others.size, others.map { paths(it) }.toSet().size, paths::class.simpleName)
    }

    @Test
    fun `the digests of numbers are the same on all JDKs`() {
        var text = ""
        val digest = object : Digest {
            override fun update(data: ByteArray) {
                text += data.decodeToString()
            }

            override fun digest() = text.encodeToByteArray()

            override fun digestToString() = text
        }
        DigestHashingFactory(digest)(2.0e-3, 0.1f, 7)
        assertEquals("37 java.lang.Double 0x1.0624dd2f1a9fcp-929 java.lang.Float 0x1.99999ap-419 java.lang.Integer 7", text)
    }

    @Test
    fun `a digest path survives serialisation`() {
        val path = DigestHashingFactory()("a", Key("b", 2))
        val text = Json.encodeToString(Path.serializer(), path)
        assertEquals(path, Json.decodeFromString(Path.serializer(), text))
        assertNotEquals(DigestHashingFactory()("a", Key("b", 3)), Json.decodeFromString(Path.serializer(), text))
    }
}
