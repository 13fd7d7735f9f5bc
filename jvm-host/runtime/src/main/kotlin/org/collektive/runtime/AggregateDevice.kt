@file:OptIn(DelicateCollektiveApi::class)

package org.collektive.runtime

import it.unibo.collektive.aggregate.AlignmentClashException
import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.FieldEntry
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi

/**
 * One device: the alignment stack of the running round, the records of the last valid round and of the running one, and those that
 * neighbours still hold.
 *
 * Generic in [ID] so that ids stay the one boxed object they were made as.
 */
internal class AggregateDevice<ID : Any>(
    override val localId: ID,
    private val tree: PathTree,
    private val rule: SharingRule,
) : Primitives<ID, PathNode>(),
    DeviceRuntime {
    override val inMemoryOnly: Boolean get() = true

    private var valid = RoundRecord()
    private var running = RoundRecord()
    private val older = ArrayList<RoundRecord>(0)
    private var inbox: Inbox? = null

    // tokens[0 until depth] is the stack; nodes[0..resolved] are the paths of its prefixes found so far, so that pivots around no
    // primitive cost no look-up.
    private var tokens = arrayOfNulls<Any?>(INITIAL_DEPTH)
    private var nodes = arrayOfNulls<PathNode>(INITIAL_DEPTH + 1).also { it[0] = tree.root }
    override var depth = 0
        private set
    private var resolved = 0

    override fun round(inbox: Inbox, program: RoundProgram): Any? {
        this.inbox = inbox
        popTo(0)
        running.clear()
        @Suppress("UNCHECKED_CAST")
        return program.run(this as Aggregate<Int>)
    }

    override val exports: Int get() = running.countSent()

    override fun commit(): Export {
        val last = valid
        valid = running
        running = if (last.isHeld) insteadOf(last) else last
        return valid
    }

    /** A record for the next round, while [held] stays as it is. */
    private fun insteadOf(held: RoundRecord): RoundRecord {
        for (index in older.indices) {
            val record = older[index]
            if (record.isHeld) continue
            older[index] = held
            return record
        }
        older += held
        return RoundRecord()
    }

    /** Paths that a neighbour can still see, or the next round of this device. */
    fun forEachPath(action: (PathNode) -> Unit) {
        valid.forEachPath(action)
        for (record in older) if (record.isHeld) record.forEachPath(action)
    }

    override fun push(token: Any?) {
        if (depth == tokens.size) {
            tokens = tokens.copyOf(2 * depth)
            nodes = nodes.copyOf(2 * depth + 1)
        }
        tokens[depth++] = token
    }

    override fun popTo(depth: Int) {
        this.depth = depth
        if (resolved > depth) resolved = depth
    }

    override fun claimPath(): PathNode {
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
    override fun <T> keptAt(path: PathNode, initial: T): T {
        val value = valid.keptAt(path)
        return if (value === RoundRecord.Nothing) initial else value as T
    }

    override fun keep(path: PathNode, value: Any?) {
        allow(value, path)
        running.keep(path, value)
    }

    override fun <T> receive(path: PathNode, local: T, sharing: DataSharingMethod<T>): Field<ID, T> {
        val inbox = checkNotNull(inbox)
        val size = inbox.size
        val values = arrayOfNulls<Any?>(size)
        val allIds = inbox.ids
        var ids = allIds
        var count = 0
        for (index in 0 until size) {
            val export = inbox.export(index) as RoundRecord?
            val value = if (export == null) RoundRecord.Nothing else export.sentTo(localId, path, inbox.wasKnown(index))
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

    override fun <T> send(path: PathNode, values: Field<ID, T>, sharing: DataSharingMethod<T>) {
        val default = values.local.value
        val neighbors = values.neighbors.list
        var isConstant = true
        for (index in neighbors.indices) {
            val value = neighbors[index].value
            if (value === default) continue
            isConstant = false
            allow(value, path)
        }
        // Receivers of a constant need not look for their value.
        running.send(path, if (isConstant) default else values)
    }

    override fun <T> sendToAll(path: PathNode, value: T, sharing: DataSharingMethod<T>) {
        allow(value, path)
        running.send(path, value)
    }

    override fun <I : Any, T> projected(field: Field<I, T>): Field<I, T> {
        val path = currentPath()
        if (running.claim(path)) running.send(path, Unit)
        val inbox = checkNotNull(inbox)
        val entries = field.neighbors.list
        val kept = ArrayList<FieldEntry<I, T>>(entries.size)
        // The field's neighbours are some of the links, in the same order.
        var link = 0
        for (entry in entries) {
            while (inbox.ids[link] != entry.id) link++
            val export = inbox.export(link) as RoundRecord?
            if (export != null && export.sentAt(path) !== RoundRecord.Nothing) kept += entry
        }
        if (kept.size == entries.size) return field
        return Field.make(field.context, Array<Any>(kept.size) { kept[it].id }, Array<Any?>(kept.size) { kept[it].value }, field.local.value)
    }

    private fun allow(value: Any?, path: PathNode) {
        rule.refusal(value)?.let {
            throw IllegalArgumentException("$it; it cannot be shared or kept (at the path '${path.describe()}')")
        }
    }

    private companion object {
        const val INITIAL_DEPTH = 8
    }
}
