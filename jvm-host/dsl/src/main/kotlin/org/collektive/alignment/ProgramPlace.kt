package org.collektive.alignment

import it.unibo.collektive.aggregate.api.Aggregate

/**
 * Where a program was when it failed: `node 3 at helper > share (Swarm.kt:12)`.
 *
 * @property node the id of the device that ran it.
 */
public class ProgramPlace(public val node: Any, tokens: List<Any?>) {
    /** The path in the program's words, outermost first; of a long one the beginning and the end. */
    public val path: String = when {
        tokens.isEmpty() -> "root"
        tokens.size <= SHOWN_FIRST + SHOWN_LAST + 1 -> tokens.joinToString(SEPARATOR, transform = ::readable)
        else -> (
            tokens.take(SHOWN_FIRST).map(::readable) + "… (${String.format(java.util.Locale.ROOT, "%,d", tokens.size - SHOWN_FIRST - SHOWN_LAST)} more)" +
                tokens.takeLast(SHOWN_LAST).map(::readable)
            ).joinToString(SEPARATOR)
    }

    /** The innermost place of the sources on the path, `Swarm.kt:12`; `null` when no compiled program is on it. */
    public val location: String? = tokens.asReversed().firstNotNullOfOrNull(::location)

    override fun toString(): String = "node $node at $path" + if (location == null) "" else " ($location)"

    private companion object {
        const val SEPARATOR = " > "
        const val SHOWN_FIRST = 8
        const val SHOWN_LAST = 2
    }
}

/** [message], followed by where this device's program is: the form of all errors of programs. */
public fun Aggregate<*>.withPlace(message: String): String =
    withPlace(message, (this as? AlignmentStack)?.place ?: ProgramPlace(localId, emptyList()))

/** [message], followed by [place]. */
public fun withPlace(message: String, place: ProgramPlace): String = "$message [$place]"
