package it.unibo.collektive.path

/** A path that is the SHA-256 [digest] of its tokens, in hexadecimal digits; [tokens], for errors, are known where it was made. */
internal class DigestPath(val digest: String, val tokens: List<Any?>? = null) : Path {
    override fun equals(other: Any?): Boolean = other is DigestPath && digest == other.digest

    override fun hashCode(): Int = digest.hashCode()

    override fun toString(): String = digest
}

/** The tokens of this path, as far as they are known here. */
internal fun Path.tokens(): List<Any?> = when (this) {
    is FullPath -> tokens
    is DigestPath -> tokens ?: listOf(this)
    else -> listOf(this)
}
