@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.aggregate.api.impl

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.InMemory

/**
 * What an [Aggregate] should offer to compiled programs beside its public functions. One that does not is aligned by
 * [Aggregate.align] and [Aggregate.dealign]: right, but a program that leaves its own `align` open then stays misaligned.
 *
 * A token is a string constant that names a place of the program. Equal tokens are one object (constants are interned), so
 * looking one up need not look at its text; [readable] and [location] show it to people.
 */
public interface AlignmentStack {
    /** Pushes [token] and returns the depth from before, for [popTo]. */
    public fun pushToken(token: String): Int

    /** Drops everything pushed since the depth was [depth]. */
    public fun popTo(depth: Int)

    /**
     * [field] without those neighbours that did not come to the current path in their last round. Asking makes this device seen
     * there. Unlike a primitive it may be asked any number of times at one path.
     */
    public fun <ID : Any, T> projected(field: Field<ID, T>): Field<ID, T>

    /** Where the program is. */
    public val place: ProgramPlace

    /** Remembers the current path as the one where [failure] came up, unless it is known already. */
    public fun failing(failure: Throwable)
}

/** Called by compiled programs before an aligned call or branch; the result is for [popToken]. */
public fun pushToken(aggregate: Aggregate<*>?, token: String): Int {
    if (aggregate is AlignmentStack) return aggregate.pushToken(token)
    aggregate?.align(token)
    return 0
}

/** Called by compiled programs after an aligned call or branch, however it ended. */
public fun popToken(aggregate: Aggregate<*>?, depth: Int) {
    if (aggregate is AlignmentStack) aggregate.popTo(depth) else aggregate?.dealign()
}

/** Called by compiled programs when [failure] leaves an aligned call or branch, before [popToken]. */
public fun noteFailure(aggregate: Aggregate<*>?, failure: Throwable) {
    if (aggregate is AlignmentStack) aggregate.failing(failure)
}

/** Called by compiled programs where a branch or an `alignedOn` body reads a [field] from outside: [field], restricted to the neighbours aligned there. */
public fun <ID : Any, T> project(field: Field<ID, T>?, token: String): Field<ID, T>? {
    if (field == null) return null
    val aggregate = field.context
    val depth = pushToken(aggregate, token)
    try {
        return if (aggregate is AlignmentStack) aggregate.projected(field) else restricted(aggregate, field)
    } finally {
        popToken(aggregate, depth)
    }
}

/** The part of a token that people read, the called function or the arm of a branch; other pivots as text. */
public fun readable(pivot: Any?): String = token(pivot)?.let { it.groupValues[1] } ?: pivot.toString()

/** The place in the program's sources that a token names, `Swarm.kt:12`; `null` for other pivots. */
public fun location(pivot: Any?): String? = token(pivot)?.let { it.groupValues[2] }

private fun token(pivot: Any?): MatchResult? = (pivot as? String)?.let(TOKEN::matchEntire)

private val TOKEN = Regex("([^@]+)@([^@]+:\\d+)#[0-9a-f]{16}")

private fun <ID : Any, T> restricted(aggregate: Aggregate<ID>, field: Field<ID, T>): Field<ID, T> {
    val aligned = aggregate.neighboring(Unit, InMemory).neighbors.list.mapTo(HashSet()) { it.id }
    val kept = field.neighbors.list.filter { it.id in aligned }
    if (kept.size == field.neighbors.size) return field
    return Field.make(
        aggregate,
        Array<Any>(kept.size) { kept[it].id },
        Array<Any?>(kept.size) { kept[it].value },
        field.local.value,
    )
}
