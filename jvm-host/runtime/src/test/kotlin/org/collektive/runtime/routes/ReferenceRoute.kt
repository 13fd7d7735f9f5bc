@file:OptIn(DelicateCollektiveApi::class)

package org.collektive.runtime.routes

import it.unibo.collektive.aggregate.AlignmentClashException
import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.YieldingContext
import it.unibo.collektive.aggregate.api.YieldingScope
import it.unibo.collektive.networking.OutboundEnvelope.SharedData
import it.unibo.collektive.path.FullPath

/** The semantics of the primitives in their simplest form: maps from whole paths to values. */
internal class ReferenceRoute : Route {
    override val name = "reference"

    /** The outcome of a round: stored values, and at each path the values for known receivers and the default. */
    class Record(val kept: Map<List<Any?>, Any?>, val sent: Map<List<Any?>, Pair<Map<Int, Any?>, Any?>>)

    val records = sortedMapOf<Int, Record>()

    override fun add(id: Int) {
        records[id] = Record(emptyMap(), emptyMap())
    }

    override fun remove(id: Int) {
        records.remove(id)
    }

    override fun round(graph: Graph, due: List<Int>, program: Aggregate<Int>.() -> Any?): Map<Int, Result<Any?>> {
        val devices = due.associateWith { Device(it, graph) }
        val results = devices.mapValues { (_, device) -> runCatching { device.program() } }
        for ((id, result) in results) if (result.isSuccess) records[id] = devices.getValue(id).let { Record(it.kept, it.sent) }
        return results
    }

    private inner class Device(override val localId: Int, private val graph: Graph) : Aggregate<Int> {
        override val inMemoryOnly get() = true
        val kept = HashMap<List<Any?>, Any?>()
        val sent = HashMap<List<Any?>, Pair<Map<Int, Any?>, Any?>>()
        private val before = records.getValue(localId)
        private val visited = HashSet<List<Any?>>()
        private var path = emptyList<Any?>()

        private fun visit(): List<Any?> {
            if (!visited.add(path)) throw AlignmentClashException(FullPath(path), null, SharedData<Int, Any?>(null))
            return path
        }

        @Suppress("UNCHECKED_CAST")
        private fun <T> old(at: List<Any?>, initial: T): T = if (at in before.kept) before.kept[at] as T else initial

        private fun <T> received(at: List<Any?>, local: T): Field<Int, T> {
            val values = sortedMapOf<Int, Any?>()
            for (sender in graph.senders(localId)) {
                val (overrides, default) = records.getValue(sender).sent[at] ?: continue
                values[sender] = if (graph.wasKnown(sender, localId) && localId in overrides) overrides[localId] else default
            }
            return Field.make(this, values.keys.toTypedArray<Any>(), values.values.toTypedArray(), local)
        }

        override fun <Stored> evolve(initial: Stored, transform: (Stored) -> Stored): Stored {
            val at = visit()
            return transform(old(at, initial)).also { kept[at] = it }
        }

        override fun <Stored, Return> evolving(initial: Stored, transform: YieldingScope<Stored, Return>): Return {
            val at = visit()
            val (new, result) = YieldingContext<Stored, Return>().transform(old(at, initial))
            kept[at] = new
            return result
        }

        override fun <Shared, Return> exchanging(
            initial: Shared,
            dataSharingMethod: DataSharingMethod<Shared>,
            body: YieldingScope<Field<Int, Shared>, Return>,
        ): Return {
            val at = visit()
            val (new, result) = YieldingContext<Field<Int, Shared>, Return>().body(received(at, old(at, initial)))
            sent[at] = new.neighbors.list.associate { it.id to it.value } to new.local.value
            kept[at] = new.local.value
            return result
        }

        override fun <Shared> neighboring(local: Shared, dataSharingMethod: DataSharingMethod<Shared>): Field<Int, Shared> {
            val at = visit()
            sent[at] = emptyMap<Int, Any?>() to local
            return received(at, local)
        }

        override fun <R> alignedOn(pivot: Any?, body: () -> R): R {
            val outside = path
            path = outside + pivot
            try {
                return body()
            } finally {
                path = outside
            }
        }

        override fun align(pivot: Any?) {
            path = path + pivot
        }

        override fun dealign() {
            path = path.dropLast(1)
        }
    }
}
