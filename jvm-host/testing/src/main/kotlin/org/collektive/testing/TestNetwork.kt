package org.collektive.testing

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.api.Device
import org.collektive.api.Parameters
import org.collektive.engine.Engine
import org.collektive.engine.EngineSettings
import org.collektive.engine.LinkList
import org.collektive.engine.NetworkModel
import org.collektive.engine.NewNode
import org.collektive.engine.NodeProgram
import org.collektive.engine.RoundData
import org.collektive.engine.RoundDevice
import org.collektive.engine.Tick
import org.collektive.engine.TickResult
import org.collektive.frames.data.ViewRule
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.RuntimeProvider
import java.util.ServiceLoader
import java.util.TreeSet
import java.util.concurrent.TimeUnit

/**
 * Runs aggregate programs on a small network of nodes and links in unit tests, on the simulator's engine and without Unity.
 *
 * ```
 * TestNetwork().use { network ->
 *     network.add(0, 1, 2)
 *     network.link(0, 1)
 *     network.link(1, 2)
 *     assertEquals(mapOf(0 to 0, 1 to 1, 2 to 2), network.rounds(3) { hopDistanceTo(localId == 0) })
 * }
 * ```
 *
 * Like programs, tests must be compiled with the compiler plugin of the runtime on their class path. Not thread-safe.
 *
 * @param seed the seed of all random numbers; the same seed gives the same answers.
 * @param deltaTime simulated seconds from one round to the next.
 * @param runtime name of the runtime, `builtIn` or `collektive`; `null` selects the one on the class path, or the built-in one if both are.
 * @param loss probability that a message is lost, 0..1.
 * @throws IllegalStateException when the runtime is not on the class path.
 */
public class TestNetwork(seed: Long = 1, private val deltaTime: Double = 1.0, runtime: String? = null, loss: Double = 0.0) :
    AutoCloseable {
    private val engine = Engine(EngineSettings(seed, network = NetworkModel(loss = loss)), runtimes(runtime))
    private val program = Program()
    private val tick = Tick()
    private val ids = TreeSet<Int>()

    // The links in the engine, and those that the next round removes, or adds or changes. The engine removes a node's links itself.
    private val links = HashSet<Pair<Int, Int>>()
    private val removedLinks = LinkedHashSet<Pair<Int, Int>>()
    private val newLinks = LinkedHashMap<Pair<Int, Int>, LinkValues>()

    /** The ids of all nodes, in ascending order. */
    public val nodes: Set<Int> get() = ids

    /** Adds nodes without links. Each of [newIds] is 0 or greater and used by no other node. */
    public fun add(vararg newIds: Int): Unit = newIds.forEach { add(it, emptyMap()) }

    /** Adds a node whose `Device.parameters` are [parameters]. */
    public fun add(id: Int, parameters: Map<String, String>) {
        require(id >= 0) { "node $id: the id must be 0 or greater" }
        require(ids.add(id)) { "node $id already exists; use another id" }
        tick.nodesAdded += NewNode(id, program, Parameters(parameters))
    }

    /** Removes node [id] with its links and its state. */
    public fun remove(id: Int) {
        known(id)
        ids -= id
        if (!tick.nodesAdded.removeIf { it.id == id }) tick.nodesRemoved.add(id)
        for (list in listOf(links, removedLinks, newLinks.keys)) list.removeIf { it.first == id || it.second == id }
    }

    /** Links [a] and [b] in both directions, or updates their links: [length] is in metres, [attenuation] 0 (clear) or greater. */
    public fun link(a: Int, b: Int, length: Double = 1.0, attenuation: Double = 0.0) {
        require(known(a) != known(b)) { "node $a cannot be linked to itself" }
        val values = LinkValues(length.toFloat(), attenuation.toFloat())
        newLinks[a to b] = values
        newLinks[b to a] = values
    }

    /** Removes the links between [a] and [b], if any. */
    public fun unlink(a: Int, b: Int) {
        for (link in listOf(known(a) to known(b), b to a)) {
            newLinks -= link
            if (links.remove(link)) removedLinks += link
        }
    }

    /**
     * Runs one round of [program] on each node and returns the answers by id. Nodes read what their neighbours sent in the previous round.
     *
     * @throws IllegalStateException when the round of a node failed. The message names the node and the place, and the cause is the original
     * exception. That node keeps the state of its last successful round; the rounds of all other nodes have run.
     */
    public fun <T> round(program: Aggregate<Int>.(Device) -> T): Map<Int, T> = outcomes(ids, program).mapValues { it.value.getOrThrow() }

    /** Runs one round of [program] on the nodes in [due]. Returns their answers or failures by id; see [round]. */
    internal fun <T> outcomes(due: Set<Int>, program: Aggregate<Int>.(Device) -> T): Map<Int, Result<T>> {
        this.program.body = program
        this.program.failures.clear()
        prepare(due)
        val result = engine.step(tick, NoFrames, System.nanoTime() + LIMIT_NANOS)
        tick.clear()
        return (0 until result.size).associate { index -> result.id(index) to outcome(result, index) }
    }

    @Suppress("UNCHECKED_CAST")
    private fun <T> outcome(result: TickResult, index: Int): Result<T> {
        val failure = result.failure(index) ?: return Result.success((result.answer(index) as Answer).value as T)
        return Result.failure(IllegalStateException("node ${result.id(index)}: $failure", program.failures[failure]))
    }

    /** Runs [count] rounds, at least one, and returns the answers of the last one; see [round]. */
    public fun <T> rounds(count: Int, program: Aggregate<Int>.(Device) -> T): Map<Int, T> {
        require(count > 0) { "the number of rounds is $count: it must be 1 or greater" }
        repeat(count - 1) { round(program) }
        return round(program)
    }

    /** Ends the engine's threads. */
    override fun close(): Unit = engine.close()

    private fun known(id: Int): Int = id.also { require(it in ids) { "unknown node $it: add it first" } }

    private fun prepare(due: Set<Int>) {
        tick.time = tick.number++ * deltaTime
        tick.deltaTime = deltaTime
        for ((from, to) in removedLinks) {
            tick.linksRemoved.add(from)
            tick.linksRemoved.add(to)
        }
        removedLinks.clear()
        tick.links =
            LinkList().also { list ->
                for ((link, values) in newLinks) list.add(link.first, link.second, values.length, values.attenuation)
            }
        links += newLinks.keys
        newLinks.clear()
        due.sorted().forEach(tick.due::add)
    }

    private class LinkValues(val length: Float, val attenuation: Float)

    /** Wraps the answer of a program, which may be `null`: the engine treats `null` as a failure. */
    private class Answer(val value: Any?)

    /** Runs the program of the current round on all nodes. */
    private class Program : NodeProgram {
        var body: Aggregate<Int>.(Device) -> Any? = {}

        /** Exceptions by their description. */
        val failures = HashMap<String, Throwable>()

        override val name: String get() = "test"

        @Suppress("UNCHECKED_CAST")
        override fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any = Answer((aggregate as Aggregate<Int>).body(device))

        override fun describe(failure: Throwable, place: String?): String =
            (if (place == null || place in failure.toString()) "$failure" else "$failure [$place]").also { failures[it] = failure }
    }

    /** Provides no sensor data: tests pass it to their programs. */
    private object NoFrames : RoundData {
        override fun sensors(worker: Int, index: Int): Any? = null

        override fun pack(worker: Int, index: Int, answer: Any): String? = null
    }

    private companion object {
        val LIMIT_NANOS = TimeUnit.MINUTES.toNanos(1)

        fun runtimes(name: String?): DeviceRuntimes {
            val found = ServiceLoader.load(RuntimeProvider::class.java).toList()
            val provider = if (name == null) found.find { it.name == "builtIn" } ?: found.firstOrNull() else found.find { it.name == name }
            checkNotNull(provider) {
                val names = found.map(RuntimeProvider::name)
                val missing = if (name == null) "no runtime is" else "the runtime $name is not"
                "$missing on the class path (found: $names): " +
                    "add collektive-library.jar for the built-in runtime, or collektive-adapter.jar and Collektive's jars"
            }
            return provider.runtimes(ViewRule)
        }
    }
}
