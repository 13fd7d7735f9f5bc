@file:OptIn(DelicateCollektiveApi::class)

package org.collektive.compiler

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
import org.collektive.alignment.readable

/**
 * Devices that store everything in maps by whole path: slow, and simple enough to be correct.
 *
 * @param linked whether two devices are neighbours; by default, all are.
 * @param plain whether devices do not implement [AlignmentStack].
 * @param unchecked whether clashes are ignored, for programs compiled without the plugin.
 */
internal class ReferenceDevices(
    vararg ids: Int,
    plain: Boolean = false,
    val unchecked: Boolean = false,
    private val linked: (Int, Int) -> Boolean = { _, _ -> true },
) {
    val devices = ids.associateWith { if (plain) PlainDevice(it, this) else ReferenceDevice(it, this) }

    /** The neighbours of [id], ascending. */
    fun neighbors(id: Int): List<PlainDevice> = devices.values.filter { it.localId != id && linked(it.localId, id) }.sortedBy { it.localId }

    /** Runs one round of all devices, which read the messages of the previous round. */
    fun round(program: Aggregate<Int>.() -> Any?): Map<Int, Any?> {
        val results = devices.mapValues { (_, device) -> device.round(program) }
        devices.values.forEach { it.commit() }
        return results
    }
}

/** Runs [program] once on a device without neighbours. Returns its result and the readable paths of its primitives. */
internal fun trace(program: Aggregate<Int>.() -> Any?): Pair<Any?, List<String>> {
    val network = ReferenceDevices(0)
    val result = network.round(program).getValue(0)
    return result to network.devices.getValue(0).visited
}

/** A device without [AlignmentStack], like one of another implementation of the API. */
internal open class PlainDevice(override val localId: Int, private val network: ReferenceDevices) : Aggregate<Int> {
    protected val stack = mutableListOf<Any?>()
    private var state = mapOf<List<Any?>, Any?>()
    private var sent = mapOf<List<Any?>, Map<Int?, Any?>>()
    private val newState = mutableMapOf<List<Any?>, Any?>()
    private val newSent = mutableMapOf<List<Any?>, Map<Int?, Any?>>()
    private val claimed = mutableSetOf<List<Any?>>()

    /** Paths of the primitives of the last round, in order. */
    val paths = mutableListOf<List<Any?>>()

    /** The readable form of these paths. */
    val visited: List<String> get() = paths.map(::describe)

    override val inMemoryOnly get() = true

    fun round(program: Aggregate<Int>.() -> Any?): Any? {
        newState.clear()
        newSent.clear()
        claimed.clear()
        paths.clear()
        stack.clear()
        val result = program()
        check(stack.isEmpty()) { "left on the stack: ${describe(stack)}" }
        return result
    }

    fun commit() {
        state = newState.toMap()
        sent = newSent.toMap()
    }

    override fun <Stored> evolve(initial: Stored, transform: (Stored) -> Stored): Stored =
        evolving(initial) { old -> transform(old).yielding { this } }

    override fun <Stored, Return> evolving(initial: Stored, transform: YieldingScope<Stored, Return>): Return {
        val path = claim()

        @Suppress("UNCHECKED_CAST")
        val old = if (path in state) state[path] as Stored else initial
        val (kept, result) = YieldingContext<Stored, Return>().transform(old)
        newState[path] = kept
        return result
    }

    override fun <Shared, Return> exchanging(
        initial: Shared,
        dataSharingMethod: DataSharingMethod<Shared>,
        body: YieldingScope<Field<Int, Shared>, Return>,
    ): Return {
        val path = claim()

        @Suppress("UNCHECKED_CAST")
        val old = if (path in state) state[path] as Shared else initial
        val (toSend, result) = YieldingContext<Field<Int, Shared>, Return>().body(received(path, old))
        newState[path] = toSend.local.value
        newSent[path] = toSend.neighbors.list.associate<_, Int?, Any?> { it.id to it.value } + (null to toSend.local.value)
        return result
    }

    override fun <Shared> neighboring(local: Shared, dataSharingMethod: DataSharingMethod<Shared>): Field<Int, Shared> {
        val path = claim()
        newSent[path] = mapOf(null to local)
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

    fun popTo(depth: Int) {
        while (stack.size > depth) stack.removeLast()
    }

    private fun claim(): List<Any?> {
        val path = stack.toList()
        if (!claimed.add(path) && !network.unchecked) {
            throw AlignmentClashException(FullPath(path), null, SharedData<Int, Any?>(null))
        }
        paths += path
        return path
    }

    protected fun markSeen() {
        newSent.putIfAbsent(stack.toList(), mapOf(null to null))
    }

    protected fun alignedHere(): Set<Int> = network.neighbors(localId).filter { stack.toList() in it.sent }.map { it.localId }.toSet()

    private fun <T> received(path: List<Any?>, local: T): Field<Int, T> {
        val senders = network.neighbors(localId).filter { path in it.sent }
        val values = senders.map { sender ->
            val message = sender.sent.getValue(path)
            if (localId in message) message[localId] else message[null]
        }
        return Field.make(this, senders.map { it.localId }.toTypedArray(), values.toTypedArray(), local)
    }

    private fun describe(path: List<Any?>) = path.joinToString(" > ") { readable(it) }
}

/** A device with [AlignmentStack], like one of the project's own runtime. */
internal class ReferenceDevice(id: Int, network: ReferenceDevices) :
    PlainDevice(id, network),
    AlignmentStack {
    /** All tokens pushed so far, in order. */
    val pushed = mutableListOf<String>()

    /** The path of the last failure, and the failure. */
    var failed: Pair<ProgramPlace, Throwable>? = null

    override val place: ProgramPlace get() = ProgramPlace(localId, stack.toList())

    override fun failing(failure: Throwable) {
        if (failed?.second !== failure) failed = place to failure
    }

    override fun pushToken(token: String): Int = stack.size.also {
        stack += token
        pushed += token
    }

    override fun <ID : Any, T> projected(field: Field<ID, T>): Field<ID, T> {
        markSeen()
        val here = alignedHere()
        val kept = field.neighbors.list.filter { entry -> here.any { it == entry.id } }
        return Field.make(
            field.context,
            kept.map<_, Any> { it.id }.toTypedArray(),
            kept.map<_, Any?> { it.value }.toTypedArray(),
            field.local.value,
        )
    }
}
