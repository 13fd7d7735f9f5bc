package org.collektive.runtime.routes

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.runtime.AggregateRuntimes
import org.collektive.runtime.round
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.Export
import org.collektive.spi.Inbox
import java.util.concurrent.Callable
import java.util.concurrent.Executors

/** The route of simulations: [threads] threads read messages in place at the same time. */
internal class FastRoute(private val threads: Int) :
    Route,
    AutoCloseable {
    override val name = "in place, $threads threads"
    private val runtimes = AggregateRuntimes()
    private val devices = sortedMapOf<Int, DeviceRuntime>()
    private val exports = HashMap<Int, Export>()
    private val pool = Executors.newFixedThreadPool(threads)

    override fun add(id: Int) {
        devices[id] = runtimes.device(id)
    }

    override fun remove(id: Int) {
        devices.remove(id)
        exports.remove(id)
    }

    override fun round(graph: Graph, due: List<Int>, program: Aggregate<Int>.() -> Any?): Map<Int, Result<Any?>> {
        runtimes.tidy(devices.values.toList())
        val tasks = due.map { id ->
            val inbox = Links(graph, id)
            Callable { runCatching { devices.getValue(id).round(inbox, program) } }
        }
        val results = due.zip(pool.invokeAll(tasks).map { it.get() }).toMap()
        for ((id, result) in results) if (result.isSuccess) exports[id] = devices.getValue(id).commit()
        return results
    }

    override fun close() = pool.shutdown()

    private inner class Links(private val graph: Graph, private val receiver: Int) : Inbox {
        private val senders = graph.senders(receiver)
        override val size get() = senders.size
        override val ids = senders.toTypedArray<Any>()
        override fun export(index: Int) = exports[senders[index]]
        override fun wasKnown(index: Int) = graph.wasKnown(senders[index], receiver)
    }
}
