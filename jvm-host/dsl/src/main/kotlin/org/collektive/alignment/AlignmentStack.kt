package org.collektive.alignment

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate

/**
 * The alignment stack of an [Aggregate] as compiled programs use it. An [Aggregate] that lacks this interface is aligned by
 * [Aggregate.align] and [Aggregate.dealign] instead; then a program that leaves an `align` of its own open stays misaligned.
 *
 * A token is a string constant that names a place of the program. Equal tokens are one object, since constants are interned, so
 * they are compared by identity; [readable] and [location] turn them into text for people.
 *
 * Threads: only the one that runs the round.
 */
public interface AlignmentStack {
    /** Pushes [token] and returns the depth before the push, for [popTo]. */
    public fun pushToken(token: String): Int

    /** Drops everything pushed since the depth was [depth]. */
    public fun popTo(depth: Int)

    /**
     * [field], restricted to the neighbours that came to the current path in their last round. This device announces itself there too.
     * Unlike a primitive, it may run any number of times at one path.
     */
    public fun <ID : Any, T> projected(field: Field<ID, T>): Field<ID, T>

    /** Where the program is now. */
    public val place: ProgramPlace

    /** Remembers the current path as the one where [failure] was thrown, unless it is known already. */
    public fun failing(failure: Throwable)
}
