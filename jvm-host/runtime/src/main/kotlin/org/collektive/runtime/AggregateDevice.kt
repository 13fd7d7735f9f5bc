@file:OptIn(DelicateCollektiveApi::class)

package org.collektive.runtime

import it.unibo.collektive.aggregate.AlignmentClashException
import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.YieldingContext
import it.unibo.collektive.aggregate.api.YieldingScope

/**
 * One device: the alignment stack of the running round, and two records, of the last valid round and of the running one.
 *
 * Generic in [ID] so that ids stay the one boxed object they were made as.
 */
internal class AggregateDevice<ID : Any>(
    override val localId: ID,
    private val tree: PathTree,
    private val rule: SharingRule,
) : Aggregate<ID>,
    DeviceRuntime {
    override val inMemoryOnly: Boolean get() = true

    private var valid = RoundRecord()
    private var running = RoundRecord()
    private var inbox: Inbox? = null

    // tokens[0 until depth] is the stack; nodes[0..resolved] are the paths of its prefixes found so far, so that pivots around no
    // primitive cost no look-up.
    private var tokens = arrayOfNulls<Any?>(INITIAL_DEPTH)
    private var nodes = arrayOfNulls<PathNode>(INITIAL_DEPTH + 1).also { it[0] = tree.root }
    private var depth = 0
    private var resolved = 0

    override fun round(inbox: Inbox, program: RoundProgram): Any? {
        this.inbox = inbox
        unwindTo(0)
        running.clear()
        @Suppress("UNCHECKED_CAST")
        return program.run(this as Aggregate<Int>)
    }

    override fun commit() {
        val last = valid
        valid = running
        running = last
    }

    fun forEachPath(action: (PathNode) -> Unit) = valid.forEachPath(action)

    override fun <Stored> evolve(initial: Stored, transform: (Stored) -> Stored): Stored {
        val path = claimPath()
        val value = transform(keptAt(path, initial))
        keep(path, value)
        return value
    }

    override fun <Stored, Return> evolving(initial: Stored, transform: YieldingScope<Stored, Return>): Return {
        val path = claimPath()
        val (kept, result) = YieldingContext<Stored, Return>().transform(keptAt(path, initial))
        keep(path, kept)
        return refuseField(result, "evolving")
    }

    override fun <Shared, Return> exchanging(
        initial: Shared,
        dataSharingMethod: DataSharingMethod<Shared>,
        body: YieldingScope<Field<ID, Shared>, Return>,
    ): Return {
        val path = claimPath()
        val received = receive(path, keptAt(path, initial))
        val (toSend, result) = YieldingContext<Field<ID, Shared>, Return>().body(received)
        for (entry in toSend.neighbors.list) allow(entry.value, path)
        keep(path, toSend.local.value)
        running.send(path, toSend)
        return result
    }

    override fun <Shared> neighboring(local: Shared, dataSharingMethod: DataSharingMethod<Shared>): Field<ID, Shared> {
        val path = claimPath()
        allow(local, path)
        running.send(path, local)
        return receive(path, local)
    }

    override fun <R> alignedOn(pivot: Any?, body: () -> R): R {
        val before = depth
        align(pivot)
        try {
            return refuseField(body(), "alignedOn")
        } finally {
            unwindTo(before)
        }
    }

    override fun align(pivot: Any?) {
        if (depth == tokens.size) {
            tokens = tokens.copyOf(2 * depth)
            nodes = nodes.copyOf(2 * depth + 1)
        }
        tokens[depth++] = pivot
    }

    override fun dealign() {
        check(depth > 0) { "dealign() without align()" }
        unwindTo(depth - 1)
    }

    private fun unwindTo(newDepth: Int) {
        depth = newDepth
        if (resolved > newDepth) resolved = newDepth
    }

    private fun claimPath(): PathNode {
        val path = currentPath()
        if (!running.claim(path)) throw AlignmentClashException(path.describe())
        return path
    }

    private fun currentPath(): PathNode {
        var node = checkNotNull(nodes[resolved])
        while (resolved < depth) {
            node = tree.child(node, tokens[resolved])
            nodes[++resolved] = node
        }
        return node
    }

    @Suppress("UNCHECKED_CAST")
    private fun <T> keptAt(path: PathNode, initial: T): T {
        val value = valid.keptAt(path)
        return if (value === RoundRecord.Nothing) initial else value as T
    }

    private fun keep(path: PathNode, value: Any?) {
        allow(value, path)
        running.keep(path, value)
    }

    /** The field of what aligned neighbours sent to this device at [path]. */
    private fun <T> receive(path: PathNode, local: T): Field<ID, T> {
        val inbox = checkNotNull(inbox)
        val size = inbox.size
        val values = arrayOfNulls<Any?>(size)
        val allIds = inbox.ids
        var ids = allIds
        var count = 0
        for (index in 0 until size) {
            val value = (inbox.sender(index) as AggregateDevice<*>).sentTo(this, path, inbox.wasKnown(index))
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

    private fun sentTo(receiver: AggregateDevice<*>, path: PathNode, receiverWasKnown: Boolean): Any? {
        val value = valid.sentAt(path)
        if (value !is Field<*, *>) return value
        @Suppress("UNCHECKED_CAST")
        val field = value as Field<Any, Any?>
        return if (receiverWasKnown) field.getOrLocal(receiver.localId) else field.local.value
    }

    private fun allow(value: Any?, path: PathNode) {
        rule.refusal(value)?.let {
            throw IllegalArgumentException("$it; it cannot be shared or kept (at the path '${path.describe()}')")
        }
    }

    private fun <T> refuseField(result: T, primitive: String): T {
        check(result !is Field<*, *>) {
            "$primitive returned a field, which would mix devices that are not aligned outside; collapse it inside"
        }
        return result
    }

    private companion object {
        const val INITIAL_DEPTH = 8
    }
}
