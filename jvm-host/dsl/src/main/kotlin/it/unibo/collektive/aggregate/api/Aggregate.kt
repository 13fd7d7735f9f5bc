package it.unibo.collektive.aggregate.api

import it.unibo.collektive.aggregate.Field

/**
 * One device during one round: the receiver of every aggregate program.
 *
 * Valid only while the round runs, and only on the thread that runs it.
 *
 * Every primitive works at a *path*, the stack of pivots put there by [alignedOn] (or [align]). Devices see each other's values
 * where their paths are equal. Two primitives at one path in one round clash
 * ([it.unibo.collektive.aggregate.AlignmentClashException]): give each a pivot of its own.
 *
 * ```
 * fun Aggregate<Int>.hottest(temperature: Double): Double {
 *     val rounds = alignedOn("rounds") { evolve(0) { it + 1 } }
 *     return alignedOn("share") { share(temperature) { seen -> maxOf(temperature, seen.neighbors.values.list.max()) } }
 * }
 * ```
 */
public interface Aggregate<ID : Any> {
    /** `true` when values never leave the process, so that any object can be shared. */
    public val inMemoryOnly: Boolean

    /** This device's id. */
    public val localId: ID

    /** Replaces the value kept at this path ([initial] at first, or when the last round did not come here) and returns it. */
    public fun <Stored> evolve(initial: Stored, transform: (Stored) -> Stored): Stored

    /**
     * Like [evolve], but returns another value than it keeps: `evolving(0) { n -> (n + 1).yielding { "round $this" } }`.
     *
     * @throws IllegalStateException when the returned value is a [Field].
     */
    public fun <Stored, Return> evolving(initial: Stored, transform: YieldingScope<Stored, Return>): Return

    /**
     * Runs [body] below [pivot]: its primitives meet only those of devices that are below an equal pivot.
     *
     * Pivots are told apart by `equals` and `hashCode`, and must not change. The stack is as before afterwards, whatever
     * [body] does.
     *
     * @throws IllegalStateException when the result is a [Field]: it would mix devices that are not aligned outside.
     */
    public fun <R> alignedOn(pivot: Any?, body: () -> R): R

    /** Pushes [pivot]; prefer [alignedOn], which cannot be left open. */
    @DelicateCollektiveApi
    public fun align(pivot: Any?)

    /** Pops the last pivot pushed by [align]. */
    @DelicateCollektiveApi
    public fun dealign()

    /** What `exchanging` becomes once the way in which values travel is known. */
    @DelicateCollektiveApi
    public fun <Shared, Return> exchanging(
        initial: Shared,
        dataSharingMethod: DataSharingMethod<Shared>,
        body: YieldingScope<Field<ID, Shared>, Return>,
    ): Return

    /** What `neighboring` becomes once the way in which values travel is known. */
    @DelicateCollektiveApi
    public fun <Shared> neighboring(local: Shared, dataSharingMethod: DataSharingMethod<Shared>): Field<ID, Shared>
}
