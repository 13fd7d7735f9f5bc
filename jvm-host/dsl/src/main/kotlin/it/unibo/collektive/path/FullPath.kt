package it.unibo.collektive.path

import org.collektive.alignment.readable

/** A path that keeps its [tokens]: exact and readable, for devices of one process. It cannot be serialised. */
public data class FullPath(public val tokens: List<Any?>) : Path {
    private val hash = tokens.hashCode()

    override fun hashCode(): Int = hash

    override fun equals(other: Any?): Boolean = this === other || other is FullPath && hash == other.hash && tokens == other.tokens

    override fun toString(): String = tokens.joinToString(" > ", transform = ::readable)
}
