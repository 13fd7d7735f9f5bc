package it.unibo.collektive.path

import java.security.MessageDigest

/**
 * Makes short paths that can be serialised: digests of the tokens' classes and texts.
 *
 * A token's `toString` must say all that its `equals` compares, and the same on all devices, as that of numbers, strings, enums and
 * data classes of these does.
 */
public object DigestHashingFactory : PathFactory {
    override fun invoke(tokens: List<Any?>): Path {
        val digest = MessageDigest.getInstance("SHA-256")
        for (token in tokens) {
            val text = "${token?.javaClass?.name} $token"
            digest.update("${text.length} $text".toByteArray())
        }
        return DigestPath(digest.digest().joinToString("") { "%02x".format(it) })
    }
}
