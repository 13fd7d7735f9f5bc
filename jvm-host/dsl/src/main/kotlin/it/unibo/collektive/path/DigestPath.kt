package it.unibo.collektive.path

/** A path that is the SHA-256 [digest] of its tokens, in hexadecimal digits. */
internal data class DigestPath(val digest: String) : Path {
    override fun toString(): String = digest
}
