package org.collektive.engine

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.api.Device
import org.collektive.api.Parameters
import org.collektive.runtime.AggregateRuntimes
import org.collektive.spi.DeviceRuntimes
import java.util.concurrent.TimeUnit

/** Creates a program from a lambda. */
internal fun program(name: String = "test", body: Aggregate<Int>.(Device) -> Any?): NodeProgram = object : NodeProgram {
    override val name = name

    @Suppress("UNCHECKED_CAST")
    override fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any? = (aggregate as Aggregate<Int>).body(device)

    override fun describe(failure: Throwable, place: String?): String = "$failure [$place]"
}

/** An engine with the real runtime, driven tick by tick. */
internal class TestEngine(
    private val program: NodeProgram,
    threads: Int = 1,
    schedule: Schedule = Schedule.LOCKSTEP,
    seed: Long = 1,
    runtimes: DeviceRuntimes = AggregateRuntimes(),
    network: NetworkModel = NetworkModel(),
) : AutoCloseable {
    val engine = Engine(EngineSettings(seed, threads, schedule, network), runtimes)
    private val data = object : RoundData {
        override fun sensors(worker: Int, index: Int): Any? = null

        override fun pack(worker: Int, index: Int, answer: Any): String? = if (answer == USELESS) "is useless" else null
    }
    var tick = 0L
        private set

    /** Runs the next tick. A rejected tick does not advance the tick number. */
    fun step(limitMillis: Long = 10_000, fill: Tick.() -> Unit): TickResult {
        val request = Tick()
        request.number = tick + 1
        request.time = request.number * 0.5
        request.deltaTime = 0.5
        request.fill()
        val result = engine.step(request, data, System.nanoTime() + TimeUnit.MILLISECONDS.toNanos(limitMillis))
        tick++
        return result
    }

    fun Tick.add(vararg ids: Int) = ids.forEach { nodesAdded.add(NewNode(it, program, Parameters(emptyMap()))) }

    fun Tick.change(id: Int) = nodesChanged.add(NewNode(id, program, Parameters(emptyMap())))

    fun Tick.link(from: Int, to: Int, length: Float = 1f, attenuation: Float = 0f) {
        val list = links as? LinkList ?: LinkList().also { links = it }
        list.add(from, to, length, attenuation)
    }

    fun Tick.unlink(from: Int, to: Int) {
        linksRemoved.add(from)
        linksRemoved.add(to)
    }

    fun Tick.due(vararg ids: Int) = ids.forEach(due::add)

    override fun close() = engine.close()

    companion object {
        const val USELESS = "useless"
    }
}

/** Returns the answers by id. A failed round has its failure instead. */
internal fun TickResult.toMap(): Map<Int, Any?> = (0 until size).associate { id(it) to (failure(it) ?: answer(it)) }
