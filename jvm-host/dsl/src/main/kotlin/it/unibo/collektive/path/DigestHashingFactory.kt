package it.unibo.collektive.path

/**
 * Creates short, serialisable paths: digests of the tokens' class names and texts. Confined to one thread, like its digest.
 *
 * A token's `toString` must contain everything that its `equals` compares, and be the same on all devices. This holds for numbers,
 * strings, enums and data classes of these.
 *
 * @property digest computes the digests; the same on all devices.
 */
@JvmInline
public value class DigestHashingFactory(public val digest: Digest = JdkDigest()) : PathFactory {
    /** @throws IllegalArgumentException when a token inherits `Any.toString`, whose result differs from device to device. */
    override fun invoke(tokens: List<Any?>): Path {
        for (token in tokens) {
            require(token is String || token == null || overridesToString(token.javaClass)) {
                "a ${token?.javaClass?.name} cannot be a pivot where messages are serialised: its class does not override toString; " +
                    "use a number, a string, an enum or a data class"
            }
        }
        for (token in tokens) {
            val text = "${token?.javaClass?.name} ${text(token)}"
            digest.update("${text.length} $text".toByteArray())
        }
        return SerializablePath(digest.digestToString(), tokens.toList())
    }

    /** Returns the text of [token]. The digits of `toString` of a real number changed in JDK 19. */
    private fun text(token: Any?) = when (token) {
        is Double -> java.lang.Double.toHexString(token)
        is Float -> java.lang.Float.toHexString(token)
        else -> token.toString()
    }

    private fun overridesToString(type: Class<*>) = type.getMethod("toString").declaringClass != Any::class.java
}
