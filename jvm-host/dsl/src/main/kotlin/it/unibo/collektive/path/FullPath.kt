package it.unibo.collektive.path

import org.collektive.alignment.readable

/** A path that keeps its tokens: exact and readable, for devices of one process. It cannot be serialised. */
public data class FullPath(internal val path: List<Any?>) : Path {
    private val hash = path.hashCode()

    override fun toMultilineString(separator: String): String = path.joinToString(separator, transform = ::readable)

    override fun hashCode(): Int = hash

    override fun equals(other: Any?): Boolean = this === other || other is FullPath && hash == other.hash && path == other.path

    override fun toString(): String = toMultilineString(" > ")

    public companion object {
        /** The path of the tokens [path], the outermost first. */
        public fun of(path: List<Any?>): Path = FullPath(path)
    }
}
