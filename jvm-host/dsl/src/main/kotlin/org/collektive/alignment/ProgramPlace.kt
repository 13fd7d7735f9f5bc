package org.collektive.alignment

import it.unibo.collektive.aggregate.api.Aggregate

/**
 * The place that a program had reached when it failed: `node 3 at helper > share (Swarm.kt:12)`.
 *
 * @property node the id of the device that ran the program.
 */
public class ProgramPlace(public val node: Any, tokens: List<Any?>) {
    /** The readable path, outermost token first. A long path is shortened to its beginning and its end. */
    public val path: String = when {
        tokens.isEmpty() -> "root"

        tokens.size <= SHOWN_FIRST + SHOWN_LAST + 1 -> tokens.joinToString(SEPARATOR, transform = ::readable)

        else -> (
            tokens.take(SHOWN_FIRST).map(::readable) +
                "… (${String.format(java.util.Locale.ROOT, "%,d", tokens.size - SHOWN_FIRST - SHOWN_LAST)} more)" +
                tokens.takeLast(SHOWN_LAST).map(::readable)
            ).joinToString(SEPARATOR)
    }

    /** The innermost source location on the path, such as `Swarm.kt:12`; `null` when no compiled program is on it. */
    public val location: String? = tokens.asReversed().firstNotNullOfOrNull(::location)

    override fun toString(): String = "node $node at $path" + if (location == null) "" else " ($location)"

    private companion object {
        const val SEPARATOR = " > "
        const val SHOWN_FIRST = 8
        const val SHOWN_LAST = 2
    }
}

/** Returns [message], followed by the place that this device's program has reached. All errors of programs have this format. */
public fun Aggregate<*>.withPlace(message: String): String =
    withPlace(message, (this as? AlignmentStack)?.place ?: ProgramPlace(localId, emptyList()))

/** Returns [message], followed by [place]. */
public fun withPlace(message: String, place: ProgramPlace): String = "$message [$place]"
