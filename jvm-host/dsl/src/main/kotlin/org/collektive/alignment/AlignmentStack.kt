package org.collektive.alignment

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate

/**
 * The alignment stack of an [Aggregate] for compiled programs. If an [Aggregate] does not implement this interface, compiled programs
 * call [Aggregate.align] and [Aggregate.dealign] instead. In that case, a program that calls `align` without `dealign` remains
 * misaligned.
 *
 * A token is a string constant that names a place in the program. Constants are interned, so tokens are compared by identity.
 * [readable] and [location] return readable texts.
 *
 * Use it only on the thread that runs the round.
 */
public interface AlignmentStack {
    /** Pushes [token] and returns the depth before the push, for [popTo]. */
    public fun pushToken(token: String): Int

    /** Like [pushToken], for the token of a branch, which begins a [region]. */
    public fun pushBranch(token: String): Int

    /**
     * Pushes the id of an entry of a field, and returns the depth before the push, for [popTo]. Primitives are aligned on the id. If the
     * field [isConstant], [projected] ignores it.
     */
    public fun pushEntry(id: Any, isConstant: Boolean): Int

    /** Pops tokens until the depth is [depth]. */
    public fun popTo(depth: Int)

    /** Identifies the running execution of the innermost branch or `alignedOn` body; 0 outside these. */
    public val region: Int

    /**
     * Returns [field] restricted to the neighbours that reached the current path in their last round, and announces to neighbours that this
     * device reached it. Unlike a primitive, it may run any number of times at one path.
     */
    public fun <ID : Any, T> projected(field: Field<ID, T>): Field<ID, T>

    /** The place that the program has reached. */
    public val place: ProgramPlace

    /** Records the current path as the place where [failure] was thrown, unless a place is already recorded. */
    public fun recordFailure(failure: Throwable)
}
