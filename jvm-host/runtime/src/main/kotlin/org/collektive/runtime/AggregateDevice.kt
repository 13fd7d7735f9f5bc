@file:OptIn(DelicateCollektiveApi::class)

package org.collektive.runtime

import it.unibo.collektive.aggregate.AlignmentClashException
import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.InMemory
import it.unibo.collektive.networking.OutboundEnvelope.SharedData
import it.unibo.collektive.networking.PayloadRepresentation
import it.unibo.collektive.path.FullPath
import org.collektive.alignment.ProgramPlace
import org.collektive.alignment.withPlace
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.Export
import org.collektive.spi.Inbox
import org.collektive.spi.RoundProgram
import org.collektive.spi.SharingRule

/**
 * One device, with the records of its last and its running round, and older records that neighbours still use.
 *
 * Generic in [ID], so that an id is boxed only once.
 */
internal class AggregateDevice<ID : Any>(
    override val localId: ID,
    private val tree: PathTree,
    private val stacks: ThreadLocal<PathStack>,
    private val rule: SharingRule,
) : Primitives<ID, PathNode>(),
    DeviceRuntime {
    override val inMemoryOnly: Boolean get() = true

    private var valid = RoundRecord()
    private var running = RoundRecord()
    private val older = ArrayList<RoundRecord>(0)
    private var inbox: Inbox? = null

    // The alignment stack of the thread that runs the round; null between rounds.
    private var ownStack: PathStack? = null
    private var lastRegion = 0
    private val stack get() = ownStack ?: outside()

    // Null on other threads, too. Only the functions that begin a use check the thread, because the check costs time.
    private val stackOfThread get() = ownStack?.takeIf { it.thread === Thread.currentThread() }
    override val depth get() = stack.depth

    override fun round(inbox: Inbox, program: RoundProgram, sensors: Any?): Any? {
        this.inbox = inbox
        clearFailure()
        running.clear()
        val stack = stacks.get()
        ownStack = stack
        stack.lastRegion = lastRegion
        try {
            return stack.running.run(this) { program.run(this, sensors) }
        } catch (failure: Throwable) {
            recordFailure(failure)
            throw failure
        } finally {
            stack.popTo(0)
            lastRegion = stack.lastRegion
            ownStack = null
        }
    }

    override val exports: Int get() = running.countSent()

    override fun placeOf(failure: Throwable): String = failurePlace(failure).toString()

    override fun commit(): Export {
        val last = valid
        valid = running
        running = if (last.isRetained) replacementOf(last) else last
        return valid
    }

    override fun state(limit: Int): List<Pair<String, Any?>> {
        val paths = ArrayList<PathNode>()
        valid.forEachPath { if (paths.size < limit && valid.storedAt(it) !== RoundRecord.Nothing) paths += it }
        val counts = paths.groupingBy(PathNode::toString).eachCount()
        return paths.map { path -> path.toString().let { if (counts[it] == 1) it else path.withLocations() } to valid.storedAt(path) }
    }

    override fun forget() {
        valid.clear()
        running.clear()
        for (record in older) record.clear()
    }

    /** Number of values that the next round can read from the last one. */
    fun countStored(): Int = valid.countStored()

    /** Applies [conversion] to everything that neighbours or this device's next round can still read. */
    fun convert(conversion: ConvertedPaths) {
        valid.convert(conversion)
        running.clear()
        for (record in older) if (record.isRetained) record.convert(conversion) else record.clear()
    }

    /** Returns a free record for the next round and stores [held] among the older ones. */
    private fun replacementOf(held: RoundRecord): RoundRecord {
        for (index in older.indices) {
            val record = older[index]
            if (record.isRetained) continue
            older[index] = held
            return record
        }
        older += held
        return RoundRecord()
    }

    /** Runs [action] on the paths that neighbours or this device's next round can still read. */
    fun forEachPath(action: (PathNode) -> Unit) {
        valid.forEachPath(action)
        for (record in older) if (record.isRetained) record.forEachPath(action)
    }

    override fun push(token: Any?) = (stackOfThread ?: outside()).push(token)

    override fun markEntry() = stack.markEntry()

    override fun beginRegion() = stack.beginRegion()

    override val region: Int get() = stackOfThread?.region ?: 0

    override fun popTo(depth: Int) = stack.popTo(depth)

    override fun tokens(): List<Any?> = stackOfThread?.tokens().orEmpty()

    override fun reservePath(value: Any?): PathNode {
        val path = (stackOfThread ?: outside()).path(this)
        if (!running.reserve(path)) throw clash(path, value)
        return path
    }

    private fun clash(path: PathNode, value: Any?): AlignmentClashException {
        val previous = when (val sent = running.sentAt(path)) {
            RoundRecord.Nothing -> null
            is Field<*, *> -> PayloadRepresentation(sent.localValue, InMemory)
            is AllButOne -> PayloadRepresentation(sent.others, InMemory)
            else -> PayloadRepresentation(sent, InMemory)
        }
        return AlignmentClashException(FullPath(tokens()), previous, SharedData<ID, Any?>(value), place)
    }

    /** Creates the path of [pivot] below [parent]. @throws IllegalArgumentException when [pivot] is not a valid pivot. */
    fun enter(parent: PathNode, pivot: Any?): PathNode {
        val reason = pivotError(pivot) ?: rule.refusal(pivot)?.let { "$it; it cannot be a pivot" } ?: return tree.enter(parent, pivot)
        throw IllegalArgumentException(withPlace(reason, ProgramPlace(localId, stack.resolvedTokens())))
    }

    @Suppress("UNCHECKED_CAST")
    override fun <T> storedAt(path: PathNode, initial: T): T {
        val value = valid.storedAt(path)
        return if (value === RoundRecord.Nothing) initial else value as T
    }

    override fun store(path: PathNode, value: Any?) {
        requireShareable(value)
        running.store(path, value)
    }

    override fun <T> receive(path: PathNode, local: T, sharing: DataSharingMethod<T>): Field<ID, T> {
        val inbox = checkNotNull(inbox)
        val size = inbox.size
        val values = arrayOfNulls<Any?>(size)
        val allIds = inbox.ids
        var ids = allIds
        var count = 0
        for (index in 0 until size) {
            val value = received(inbox, index, path)
            if (value === RoundRecord.Nothing) {
                if (ids === allIds) ids = allIds.copyOf()
            } else {
                if (ids !== allIds) ids[count] = allIds[index]
                values[count++] = value
            }
        }
        return if (count == size) {
            Field.make(this, allIds, values, local)
        } else {
            Field.make(this, ids.copyOfRange(0, count), values.copyOf(count), local)
        }
    }

    /** The value on link [index] for this device at [path], or [RoundRecord.Nothing]. */
    private fun received(inbox: Inbox, index: Int, path: PathNode): Any? {
        val export = inbox.export(index) as RoundRecord? ?: return RoundRecord.Nothing
        return when (val sent = export.sentAt(path)) {
            is AllButOne -> if (sent.id == localId && inbox.wasKnown(index)) sent.value else sent.others

            is Field<*, *> -> {
                @Suppress("UNCHECKED_CAST")
                val field = sent as Field<ID, Any?>
                if (inbox.wasKnown(index)) field.getOrLocal(localId) else field.localValue
            }

            else -> sent
        }
    }

    override fun <T> send(path: PathNode, values: Field<ID, T>, sharing: DataSharingMethod<T>) {
        val others = values.localValue
        var one = -1
        var exceptions = 0
        if (!values.isConstant) {
            for (index in 0 until values.neighborCount) {
                val value = values.neighborValue(index)
                if (value === others) continue
                one = index
                exceptions++
                requireShareable(value)
            }
        }
        val sent = when (exceptions) {
            0 -> others
            1 -> AllButOne(values.neighborId(one), values.neighborValue(one), others)
            else -> values
        }
        running.send(path, sent)
    }

    override fun <T> sendToAll(path: PathNode, value: T, sharing: DataSharingMethod<T>) {
        requireShareable(value)
        running.send(path, value)
    }

    override fun <I : Any, T> projected(field: Field<I, T>): Field<I, T> {
        val path = stack.projectionPath(this)
        if (running.reserve(path)) running.send(path, Unit)
        val inbox = checkNotNull(inbox)
        val ids = inbox.ids
        val keptIds = arrayOfNulls<Any>(field.neighborCount)
        val keptValues = arrayOfNulls<Any?>(field.neighborCount)
        var count = 0
        // The field's neighbours are a subsequence of the links, except in a field stored in an earlier round.
        var from = 0
        for (index in 0 until field.neighborCount) {
            val id: Any = field.neighborId(index)
            var link = from
            while (link < ids.size && ids[link] != id) link++
            if (link == ids.size) continue
            from = link + 1
            val export = inbox.export(link) as RoundRecord? ?: continue
            if (export.sentAt(path) === RoundRecord.Nothing) continue
            keptIds[count] = id
            keptValues[count++] = field.neighborValue(index)
        }
        if (count == field.neighborCount) return field
        return Field.make(field.context, keptIds.copyOf(count).requireNoNulls(), keptValues.copyOf(count), field.localValue)
    }

    private fun outside(): Nothing = error("device $localId or one of its fields is used outside its round or on another thread")

    private fun requireShareable(value: Any?) {
        rule.refusal(value)?.let { throw IllegalArgumentException(withPlace("$it; it cannot be shared or stored")) }
    }
}
