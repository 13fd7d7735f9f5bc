@file:OptIn(DelicateCollektiveApi::class)

// The compiler plugin inserts calls to these functions. Do not call them directly.

package org.collektive.alignment

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.InMemory

/** Returns the device whose round runs on this thread, or `null`. Used by functions that receive the device inside another object. */
public fun runningDevice(): Aggregate<*>? = RunningDevice.ofThread().device

/** Called before an aligned call. Returns the depth to pass to [popToken]. */
public fun pushToken(aggregate: Aggregate<*>?, token: String): Int {
    if (aggregate is AlignmentStack) return aggregate.pushToken(token)
    aggregate?.align(token)
    return 0
}

/** [pushToken] for a branch. */
public fun pushBranchToken(aggregate: Aggregate<*>?, token: String): Int =
    if (aggregate is AlignmentStack) aggregate.pushBranch(token) else pushToken(aggregate, token)

/**
 * Called at the beginning of a lambda that is written outside aggregate functions, with a token that identifies the lambda.
 *
 * At depth 0, the lambda is the whole program of a device. The token is dropped there, so programs from different lambdas are aligned
 * where they make the same calls. If [aggregate] does not implement [AlignmentStack], its depth is unknown and the token stays.
 */
public fun pushLambdaToken(aggregate: Aggregate<*>?, token: String): Int = pushToken(aggregate, token).also { depth ->
    if (depth == 0 && aggregate is AlignmentStack) aggregate.popTo(0)
}

/** Called after an aligned call or branch, even if it throws an exception. */
public fun popToken(aggregate: Aggregate<*>?, depth: Int) {
    if (aggregate is AlignmentStack) aggregate.popTo(depth) else aggregate?.dealign()
}

/** Called before [popToken] when [failure] leaves an aligned call or branch. */
public fun recordFailure(aggregate: Aggregate<*>?, failure: Throwable) {
    if (aggregate is AlignmentStack) aggregate.recordFailure(failure)
}

/**
 * Restricts [field], if it was created outside the running branch or `alignedOn` body, to the neighbours that are aligned inside. Called
 * where it is read. [isInside] is whether the source shows a branch around the read and the field outside it. It replaces
 * [AlignmentStack.region] on devices without [AlignmentStack].
 */
public fun <ID : Any, T> project(field: Field<ID, T>?, token: String, isInside: Boolean): Field<ID, T>? {
    if (field == null) return null
    val aggregate = field.context
    if (aggregate !is AlignmentStack) return if (isInside) restricted(aggregate, field, token) else field
    val region = aggregate.region
    if (region == 0 || region == field.region) return field
    val depth = aggregate.pushToken(token)
    try {
        return aggregate.projected(field).inRegion(region)
    } finally {
        aggregate.popTo(depth)
    }
}

private fun <ID : Any, T> restricted(aggregate: Aggregate<ID>, field: Field<ID, T>, token: String): Field<ID, T> {
    aggregate.align(token)
    val aligned = try {
        aggregate.neighboring(Unit, InMemory).neighbors.list.mapTo(HashSet()) { it.id }
    } finally {
        aggregate.dealign()
    }
    val alignedEntries = field.neighbors.list.filter { it.id in aligned }
    if (alignedEntries.size == field.neighbors.size) return field
    return Field.make(
        aggregate,
        Array<Any>(alignedEntries.size) { alignedEntries[it].id },
        Array<Any?>(alignedEntries.size) { alignedEntries[it].value },
        field.local.value,
    )
}
