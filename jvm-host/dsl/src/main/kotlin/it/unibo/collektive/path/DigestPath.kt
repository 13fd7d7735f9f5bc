package it.unibo.collektive.path

/** The SHA-256 [digest] of a path's tokens, in hexadecimal. [tokens] serve error messages; they are `null` on a received path. */
internal class DigestPath(val digest: String, val tokens: List<Any?>? = null) : Path {
    override fun equals(other: Any?): Boolean = other is DigestPath && digest == other.digest

    override fun hashCode(): Int = digest.hashCode()

    override fun toString(): String = digest
}

/** The tokens of this path, or the path itself where they are unknown. */
internal fun Path.tokens(): List<Any?> = when (this) {
    is FullPath -> tokens
    is DigestPath -> tokens ?: listOf(this)
    else -> listOf(this)
}
