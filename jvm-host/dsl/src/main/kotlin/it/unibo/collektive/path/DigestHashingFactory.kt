package it.unibo.collektive.path

import java.security.MessageDigest

/**
 * Makes short, serialisable paths: SHA-256 digests of the tokens' class names and texts.
 *
 * A token's `toString` must contain everything that its `equals` compares, and be the same on all devices. Numbers, strings, enums
 * and data classes of these qualify.
 */
public object DigestHashingFactory : PathFactory {
    /** @throws IllegalArgumentException when a token inherits `Any.toString`, whose result differs from device to device. */
    override fun invoke(tokens: List<Any?>): Path {
        val digest = MessageDigest.getInstance("SHA-256")
        for (token in tokens) {
            require(token is String || token == null || saysWhatItIs(token.javaClass)) {
                "a ${token?.javaClass?.name} cannot be a pivot where messages are serialised: it has no toString of its own; " +
                    "use a number, a string, an enum or a data class"
            }
            val text = "${token?.javaClass?.name} $token"
            digest.update("${text.length} $text".toByteArray())
        }
        return DigestPath(digest.digest().joinToString("") { "%02x".format(it) }, tokens.toList())
    }

    private fun saysWhatItIs(type: Class<*>) = type.getMethod("toString").declaringClass != Any::class.java
}
