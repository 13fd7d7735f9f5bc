package it.unibo.collektive.path

import kotlinx.serialization.Serializable
import kotlinx.serialization.Transient
import org.collektive.alignment.readable

/**
 * A path as a short text.
 *
 * @property backend the digest of its tokens.
 */
@Serializable
public class SerializablePath internal constructor(
    public val backend: String,
    // The tokens, for error messages; null if the path arrived in a message.
    @Transient internal val known: List<Any?>? = null,
) : Path {
    /** A path that arrived in a message. */
    public constructor(backend: String) : this(backend, null)

    override fun toMultilineString(separator: String): String = known?.joinToString(separator, transform = ::readable) ?: backend

    override fun equals(other: Any?): Boolean = other is SerializablePath && backend == other.backend

    override fun hashCode(): Int = backend.hashCode()

    override fun toString(): String = backend
}
