@file:OptIn(DelicateCollektiveApi::class)

package org.collektive.runtime

import it.unibo.collektive.aggregate.AggregateResult
import it.unibo.collektive.aggregate.AlignmentClashException
import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.Aggregate.Companion.dataSharingMethod
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.networking.NeighborsData
import it.unibo.collektive.networking.OutboundEnvelope.SharedData
import it.unibo.collektive.path.Path
import it.unibo.collektive.path.PathFactory
import it.unibo.collektive.state.State
import org.collektive.alignment.RunningDevice
import org.collektive.alignment.withPlace

/** One round of a device that reaches its neighbours through messages. */
internal class MailboxRound<ID : Any>(
    override val localId: ID,
    override val inMemoryOnly: Boolean,
    private val pathFactory: PathFactory,
    private val previousState: State,
    private val inbound: NeighborsData<ID>,
) : Primitives<ID, Path>() {
    private val stack = ArrayList<Any?>()

    // The stack depths at which ids of entries were pushed.
    private val entries = ArrayList<Int>(0)

    // The stack depths at which regions began, and the regions.
    private val regions = ArrayList<Pair<Int, Int>>(0)
    private var lastRegion = 0
    private val visited = HashSet<Path>()
    private val newState = LinkedHashMap<Path, Any?>()
    private val outbound = Envelope(localId)
    private val neighbors = ascending(inbound.neighbors)

    fun <R> run(program: Aggregate<ID>.() -> R): AggregateResult<ID, R> {
        val result = try {
            RunningDevice.ofThread().run(this) { program() }
        } catch (failure: StackOverflowError) {
            throw StackOverflowError(withPlace("infinite recursion", failurePlace(failure))).initCause(failure)
        }
        return AggregateResult(localId, result, outbound, newState)
    }

    override val depth get() = stack.size

    override fun push(token: Any?) {
        pivotError(token)?.let { throw IllegalArgumentException(withPlace(it)) }
        stack += token
    }

    override fun markEntry() {
        entries += stack.size
    }

    override fun beginRegion() {
        regions += stack.size to ++lastRegion
    }

    override val region: Int get() = regions.lastOrNull()?.second ?: 0

    override fun tokens(): List<Any?> = stack.toList()

    override fun popTo(depth: Int) {
        while (stack.size > depth) stack.removeLast()
        while (entries.isNotEmpty() && entries.last() > depth) entries.removeLast()
        while (regions.isNotEmpty() && regions.last().first > depth) regions.removeLast()
    }

    override fun reservePath(value: Any?): Path {
        val path = path(stack)
        if (!visited.add(path)) throw AlignmentClashException(path, outbound.defaultAt(path), SharedData<ID, Any?>(value), place)
        return path
    }

    private fun path(tokens: List<Any?>): Path = try {
        pathFactory(tokens)
    } catch (failure: IllegalArgumentException) {
        throw IllegalArgumentException(withPlace(failure.message.orEmpty()), failure)
    }

    @Suppress("UNCHECKED_CAST")
    override fun <T> storedAt(path: Path, initial: T): T = if (path in previousState) previousState[path] as T else initial

    override fun store(path: Path, value: Any?) {
        newState[path] = value
    }

    override fun <T> receive(path: Path, local: T, sharing: DataSharingMethod<T>): Field<ID, T> {
        val received = inbound.dataAt(path, sharing)
        val aligned = neighbors.filter { it in received }
        return Field.make(
            this,
            Array<Any>(aligned.size, aligned::get),
            Array<Any?>(aligned.size) { received[aligned[it]] },
            local,
        )
    }

    override fun <T> send(path: Path, values: Field<ID, T>, sharing: DataSharingMethod<T>) {
        val default = values.local.value
        val overrides = LinkedHashMap<ID, T>()
        for ((id, value) in values.neighbors.list) if (!isSame(value, default)) overrides[id] = value
        outbound.addData(path, SharedData(default, overrides), sharing)
    }

    override fun <T> sendToAll(path: Path, value: T, sharing: DataSharingMethod<T>) {
        outbound.addData(path, SharedData(value), sharing)
    }

    override fun <I : Any, T> projected(field: Field<I, T>): Field<I, T> {
        val path = path(if (entries.isEmpty()) stack else stack.filterIndexed { index, _ -> index + 1 !in entries })
        val sharing = dataSharingMethod<Unit>()
        if (visited.add(path)) sendToAll(path, Unit, sharing)
        val aligned = inbound.dataAt(path, sharing).keys as Set<*>
        val alignedEntries = field.neighbors.list.filter { it.id in aligned }
        if (alignedEntries.size == field.neighbors.size) return field
        return Field.make(
            field.context,
            Array<Any>(alignedEntries.size) {
                alignedEntries[it].id
            },
            Array<Any?>(alignedEntries.size) { alignedEntries[it].value },
            field.local.value,
        )
    }

    private companion object {
        /** Returns whether a message can replace [a] by [b]. Only `equals` of built-in types compares everything. */
        fun isSame(a: Any?, b: Any?) = a === b || (a is Number || a is String || a is Boolean || a is Char) && a == b

        /** Returns [ids], sorted if they are comparable, because fields require sorted numbers. */
        fun <ID : Any> ascending(ids: Set<ID>): List<ID> {
            val type = ids.firstOrNull()?.javaClass
            if (ids.any { it !is Comparable<*> || it.javaClass != type }) return ids.toList()
            @Suppress("UNCHECKED_CAST")
            return ids.sortedWith { a, b -> (a as Comparable<Any>).compareTo(b) }
        }
    }
}
