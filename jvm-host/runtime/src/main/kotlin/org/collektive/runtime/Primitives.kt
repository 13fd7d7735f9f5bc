@file:OptIn(DelicateCollektiveApi::class)

package org.collektive.runtime

import it.unibo.collektive.aggregate.AlignmentClashException
import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.YieldingContext
import it.unibo.collektive.aggregate.api.YieldingScope
import org.collektive.alignment.AlignmentStack
import org.collektive.alignment.ProgramPlace
import org.collektive.alignment.withPlace

/** The semantics of the primitives, independent of how devices reach each other. [Path] is the subclass's representation of paths. */
internal abstract class Primitives<ID : Any, Path : Any> :
    Aggregate<ID>,
    AlignmentStack {
    /** The number of tokens on the alignment stack. */
    protected abstract val depth: Int

    /** A copy of the tokens, outermost first. */
    protected abstract fun tokens(): List<Any?>

    /** Pushes [token]. */
    protected abstract fun push(token: Any?)

    /** Marks the last token as the id of an entry, which paths of projections omit. */
    protected abstract fun markEntry()

    /** Begins a [region], which ends when the last token is popped. */
    protected abstract fun beginRegion()

    /**
     * Reserves the current path for a primitive that starts from [value], and returns it.
     *
     * @throws AlignmentClashException when a primitive of this round already uses the path.
     */
    protected abstract fun reservePath(value: Any?): Path

    /** Returns the value that the last round stored at [path], or [initial] if it stored none. */
    protected abstract fun <T> storedAt(path: Path, initial: T): T

    /** Stores [value] for the next round. */
    protected abstract fun store(path: Path, value: Any?)

    /** Returns the field of the values that aligned neighbours sent to this device at [path]. */
    protected abstract fun <T> receive(path: Path, local: T, sharing: DataSharingMethod<T>): Field<ID, T>

    /** Sends each neighbour its value in [values], and all other receivers the local value. */
    protected abstract fun <T> send(path: Path, values: Field<ID, T>, sharing: DataSharingMethod<T>)

    /** Sends [value] to all receivers. */
    protected abstract fun <T> sendToAll(path: Path, value: T, sharing: DataSharingMethod<T>)

    private var failure: Throwable? = null
    private var failedAt = emptyList<Any?>()

    override val place: ProgramPlace get() = ProgramPlace(localId, tokens())

    override fun recordFailure(failure: Throwable) {
        if (failure === this.failure) return
        failedAt = tokens()
        this.failure = failure
    }

    /** The place where [failure], which ended the round, was thrown. */
    fun failurePlace(failure: Throwable): ProgramPlace = ProgramPlace(localId, if (failure === this.failure) failedAt else tokens())

    /** Clears the failure of the last round. */
    protected fun clearFailure() {
        failure = null
        failedAt = emptyList()
    }

    /** Returns why [pivot] cannot align devices, or `null` if it can. */
    protected fun pivotError(pivot: Any?): String? = when {
        pivot is Field<*, *> || pivot is Aggregate<*> -> "a ${pivot.javaClass.simpleName} cannot be a pivot: it differs on each device"

        pivot is Function<*> || pivot != null && pivot.javaClass.isArray ->
            "a ${pivot.javaClass.simpleName} cannot be a pivot: it is compared by identity; use a number, a string, a list or a data class"

        else -> null
    }

    override fun <Stored> evolve(initial: Stored, transform: (Stored) -> Stored): Stored {
        val path = reservePath(initial)
        val value = transform(storedAt(path, initial))
        store(path, value)
        return rejectField(value, "evolve")
    }

    override fun <Stored, Return> evolving(initial: Stored, transform: YieldingScope<Stored, Return>): Return {
        val path = reservePath(initial)
        val (stored, result) = YieldingContext<Stored, Return>().transform(storedAt(path, initial))
        store(path, stored)
        return rejectField(result, "evolving")
    }

    override fun <Shared, Return> exchanging(
        initial: Shared,
        dataSharingMethod: DataSharingMethod<Shared>,
        body: YieldingScope<Field<ID, Shared>, Return>,
    ): Return {
        val path = reservePath(initial)
        val received = receive(path, storedAt(path, initial), dataSharingMethod)
        val (toSend, result) = YieldingContext<Field<ID, Shared>, Return>().body(received)
        send(path, toSend, dataSharingMethod)
        store(path, toSend.local.value)
        return result
    }

    override fun <Shared> neighboring(local: Shared, dataSharingMethod: DataSharingMethod<Shared>): Field<ID, Shared> {
        val path = reservePath(local)
        sendToAll(path, local, dataSharingMethod)
        return receive(path, local, dataSharingMethod)
    }

    override fun <R> alignedOn(pivot: Any?, body: () -> R): R {
        val before = depth
        align(pivot)
        try {
            return rejectField(body(), "alignedOn")
        } catch (failure: Throwable) {
            recordFailure(failure)
            throw failure
        } finally {
            popTo(before)
        }
    }

    override fun align(pivot: Any?) {
        push(pivot)
        beginRegion()
    }

    override fun dealign() {
        check(depth > 0) { withPlace("dealign() was called without align()") }
        popTo(depth - 1)
    }

    override fun pushToken(token: String): Int = depth.also { push(token) }

    override fun pushBranch(token: String): Int = depth.also { align(token) }

    override fun pushEntry(id: Any, isConstant: Boolean): Int = depth.also {
        push(id)
        if (isConstant) markEntry()
    }

    private fun <T> rejectField(result: T, primitive: String): T {
        check(result !is Field<*, *>) {
            withPlace("$primitive returned a field, whose neighbours may not be aligned outside it; collapse the field first")
        }
        return result
    }
}
