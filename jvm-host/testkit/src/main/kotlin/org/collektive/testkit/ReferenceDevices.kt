@file:OptIn(DelicateCollektiveApi::class)

package org.collektive.testkit

import it.unibo.collektive.aggregate.AlignmentClashException
import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.YieldingContext
import it.unibo.collektive.aggregate.api.YieldingScope
import it.unibo.collektive.networking.OutboundEnvelope.SharedData
import it.unibo.collektive.path.FullPath
import org.collektive.alignment.AlignmentStack
import org.collektive.alignment.ProgramPlace
import org.collektive.alignment.RunningDevice
import org.collektive.alignment.readable
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.Export
import org.collektive.spi.Inbox
import org.collektive.spi.RoundProgram

/**
 * A reference implementation of the API that stores all values in maps by path. Slow, but simple enough to be obviously correct.
 *
 * @param isAligned whether devices implement [AlignmentStack].
 * @param ignoresClashes whether two primitives may share a path, as in programs that are compiled without the plugin.
 */
public class ReferenceDevices(private val isAligned: Boolean = true, private val ignoresClashes: Boolean = false) : DeviceRuntimes {
    override fun device(id: Int): ReferenceDevice =
        if (isAligned) AlignedDevice(id, ignoresClashes) else ReferenceDevice(id, ignoresClashes)

    /** Nothing to free: devices share no state. */
    override fun freeUnused(devices: List<DeviceRuntime>) {}
}

/** A device without [AlignmentStack], as in other implementations of the API. */
public open class ReferenceDevice internal constructor(override val localId: Int, private val ignoresClashes: Boolean) :
    Aggregate<Int>,
    DeviceRuntime {
    protected val stack: MutableList<Any?> = mutableListOf()
    private var inbox: Inbox? = null
    private var last = Record()
    private var running = Record()

    /** Paths of the primitives of the last round, in order. */
    public val paths: Set<List<Any?>> get() = running.paths

    /** These paths as readable text. */
    public val visited: List<String> get() = paths.map(::describe)

    /** The values that the last successful round stored, by path. */
    public val state: Map<List<Any?>, Any?> get() = last.stored

    override val inMemoryOnly: Boolean get() = true

    override fun round(inbox: Inbox, program: RoundProgram, sensors: Any?): Any? {
        this.inbox = inbox
        running = Record()
        stack.clear()
        val answer = RunningDevice.ofThread().run(this) { program.run(this, sensors) }
        check(stack.isEmpty()) { "tokens left on the stack: ${describe(stack)}" }
        return answer
    }

    override fun commit(): Export = running.also { last = it }

    override val exports: Int get() = running.sent.size

    override fun placeOf(failure: Throwable): String? = null

    override fun <Stored> evolve(initial: Stored, transform: (Stored) -> Stored): Stored =
        evolving(initial) { old -> transform(old).yielding { this } }

    override fun <Stored, Return> evolving(initial: Stored, transform: YieldingScope<Stored, Return>): Return {
        val path = visit()
        val (stored, result) = YieldingContext<Stored, Return>().transform(storedAt(path, initial))
        running.stored[path] = stored
        return result
    }

    override fun <Shared, Return> exchanging(
        initial: Shared,
        dataSharingMethod: DataSharingMethod<Shared>,
        body: YieldingScope<Field<Int, Shared>, Return>,
    ): Return {
        val path = visit()
        val (toSend, result) = YieldingContext<Field<Int, Shared>, Return>().body(received(path, storedAt(path, initial)))
        running.stored[path] = toSend.local.value
        running.sent[path] = SharedData(toSend.local.value, toSend.neighbors.list.associate { it.id to it.value })
        return result
    }

    override fun <Shared> neighboring(local: Shared, dataSharingMethod: DataSharingMethod<Shared>): Field<Int, Shared> {
        val path = visit()
        running.sent[path] = SharedData(local)
        return received(path, local)
    }

    override fun <R> alignedOn(pivot: Any?, body: () -> R): R {
        val before = stack.size
        align(pivot)
        try {
            return body()
        } finally {
            popTo(before)
        }
    }

    override fun align(pivot: Any?) {
        stack += pivot
    }

    override fun dealign() {
        stack.removeLast()
    }

    /** Pops tokens until the depth is [depth]. */
    public open fun popTo(depth: Int) {
        while (stack.size > depth) stack.removeLast()
    }

    /** Announces to neighbours that this device reached [path]. */
    protected fun markSeen(path: List<Any?>) {
        running.sent.putIfAbsent(path, SharedData(null))
    }

    /** The values that neighbours sent to this device from [path] in their last round, by id. */
    protected fun messages(path: List<Any?>): Map<Int, Any?> = buildMap {
        val inbox = checkNotNull(inbox)
        for (index in 0 until inbox.size) {
            val message = (inbox.export(index) as Record?)?.sent?.get(path) ?: continue
            put(inbox.ids[index] as Int, if (inbox.wasKnown(index)) message[localId] else message.default)
        }
    }

    private fun visit(): List<Any?> {
        val path = stack.toList()
        if (running.paths.add(path) || ignoresClashes) return path
        throw AlignmentClashException(FullPath(path), null, SharedData<Int, Any?>(null))
    }

    @Suppress("UNCHECKED_CAST")
    private fun <T> storedAt(path: List<Any?>, initial: T): T = if (path in last.stored) last.stored[path] as T else initial

    private fun <T> received(path: List<Any?>, local: T): Field<Int, T> =
        messages(path).let { Field.make(this, it.keys.toTypedArray(), it.values.toTypedArray(), local) }

    private fun describe(path: List<Any?>) = path.joinToString(" > ") { readable(it) }

    /** The outcome of a round: visited paths, stored values, and the values to send. */
    private class Record : Export() {
        val paths = LinkedHashSet<List<Any?>>()
        val stored = HashMap<List<Any?>, Any?>()
        val sent = HashMap<List<Any?>, SharedData<Int, Any?>>()
    }
}

/** A device with [AlignmentStack], as in the built-in runtime. */
public class AlignedDevice internal constructor(id: Int, ignoresClashes: Boolean) :
    ReferenceDevice(id, ignoresClashes),
    AlignmentStack {
    /** All tokens pushed so far, in order. */
    public val pushed: MutableList<String> = mutableListOf()

    /** The last failure and its path. */
    public var failed: Pair<ProgramPlace, Throwable>? = null
        private set

    // The stack depths at which ids of entries were pushed.
    private val entries = ArrayList<Int>()

    // The stack depths at which regions began, and the regions.
    private val regions = ArrayList<Pair<Int, Int>>()
    private var lastRegion = 0

    override val region: Int get() = regions.lastOrNull()?.second ?: 0

    override val place: ProgramPlace get() = ProgramPlace(localId, stack.toList())

    override fun recordFailure(failure: Throwable) {
        if (failed?.second !== failure) failed = place to failure
    }

    override fun pushToken(token: String): Int = stack.size.also {
        stack += token
        pushed += token
    }

    override fun pushBranch(token: String): Int = pushToken(token).also { beginRegion() }

    override fun align(pivot: Any?) {
        super.align(pivot)
        beginRegion()
    }

    override fun dealign() {
        popTo(stack.size - 1)
    }

    private fun beginRegion() {
        regions += stack.size to ++lastRegion
    }

    override fun pushEntry(id: Any, isConstant: Boolean): Int = stack.size.also {
        stack += id
        if (isConstant) entries += stack.size
    }

    override fun popTo(depth: Int) {
        super.popTo(depth)
        entries.removeIf { it > depth }
        regions.removeIf { it.first > depth }
    }

    override fun <ID : Any, T> projected(field: Field<ID, T>): Field<ID, T> {
        val path = stack.filterIndexed { index, _ -> index + 1 !in entries }
        markSeen(path)
        val senders = messages(path).keys
        val kept = field.neighbors.list.filter { entry -> senders.any { it == entry.id } }
        return Field.make(
            field.context,
            kept.map<_, Any> { it.id }.toTypedArray(),
            kept.map<_, Any?> { it.value }.toTypedArray(),
            field.local.value,
        )
    }
}
