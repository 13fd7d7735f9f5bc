package org.collektive.testing

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.api.Device
import org.collektive.api.Parameters
import org.collektive.engine.Engine
import org.collektive.engine.EngineSettings
import org.collektive.engine.LinkList
import org.collektive.engine.NewNode
import org.collektive.engine.NodeProgram
import org.collektive.engine.RoundData
import org.collektive.engine.RoundDevice
import org.collektive.engine.Tick
import org.collektive.frames.data.ViewRule
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.RuntimeProvider
import java.util.ServiceLoader
import java.util.TreeSet
import java.util.concurrent.TimeUnit

/**
 * A small network for tests of aggregate programs: nodes, links and rounds, on the engine of simulations and without Unity.
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
 * Tests are compiled with the compiler plugin of the runtime on their class path, as programs are. Confined to one thread at a time.
 *
 * @param seed the seed of all random numbers; the same seed gives the same answers.
 * @param deltaTime simulated seconds from one round to the next.
 * @param runtime name of the runtime, `builtIn` or `collektive`; `null`: the one on the class path, the built-in one if there are both.
 * @throws IllegalStateException when the runtime is not on the class path.
 */
public class TestNetwork(seed: Long = 1, private val deltaTime: Double = 1.0, runtime: String? = null) : AutoCloseable {
    private val engine = Engine(EngineSettings(seed), runtimes(runtime))
    private val program = Program()
    private val tick = Tick()
    private val ids = TreeSet<Int>()

    // Links as the engine knows them, and what the next round changes.
    private val links = HashSet<Pair<Int, Int>>()
    private val newLinks = LinkedHashMap<Pair<Int, Int>, LinkValues>()

    /** The ids of all nodes, in ascending order. */
    public val nodes: Set<Int> get() = ids

    /** Adds nodes without links. Each of [newIds] is 0 or greater and used by no other node. */
    public fun add(vararg newIds: Int): Unit = newIds.forEach { add(it, emptyMap()) }

    /** Adds a node whose `Device.parameters` are [parameters]. */
    public fun add(id: Int, parameters: Map<String, String>) {
        require(id >= 0) { "node $id: ids are 0 or greater" }
        require(ids.add(id)) { "there is a node $id already" }
        tick.nodesAdded += NewNode(id, program, Parameters(parameters))
    }

    /** Removes node [id] with its links and its state. */
    public fun remove(id: Int) {
        existing(id)
        ids -= id
        if (!tick.nodesAdded.removeIf { it.id == id }) tick.nodesRemoved.add(id)
        links.removeIf { it.first == id || it.second == id }
        newLinks.keys.removeIf { it.first == id || it.second == id }
    }

    /** Links [a] and [b] in both directions, or changes their link: [length] in metres, [attenuation] 0 (clear) or greater. */
    public fun link(a: Int, b: Int, length: Double = 1.0, attenuation: Double = 0.0) {
        require(existing(a) != existing(b)) { "node $a cannot have a link with itself" }
        val values = LinkValues(length.toFloat(), attenuation.toFloat())
        newLinks[a to b] = values
        newLinks[b to a] = values
    }

    /** Removes the link of [a] and [b]; nothing happens when there is none. */
    public fun unlink(a: Int, b: Int) {
        for (link in listOf(existing(a) to existing(b), b to a)) {
            newLinks -= link
            if (!links.remove(link)) continue
            tick.linksRemoved.add(link.first)
            tick.linksRemoved.add(link.second)
        }
    }

    /**
     * Runs one round of [program] on each node, and returns the answers by id. Nodes read what their neighbours sent in the round before.
     *
     * @throws IllegalStateException when the round of a node failed; the message names the node and the place, and the cause is what was
     * thrown. That node keeps the state of its last good round; all others have run theirs.
     */
    public fun <T> round(program: Aggregate<Int>.(Device) -> T): Map<Int, T> {
        this.program.body = program
        this.program.failures.clear()
        prepare()
        val result = engine.step(tick, NoFrames, System.nanoTime() + LIMIT_NANOS)
        tick.clear()
        val answers = LinkedHashMap<Int, T>()
        for (index in 0 until result.size) {
            result.failure(index)?.let { throw IllegalStateException("node ${result.id(index)}: $it", this.program.failures[it]) }
            @Suppress("UNCHECKED_CAST")
            answers[result.id(index)] = (result.answer(index) as Answer).value as T
        }
        return answers
    }

    /** Runs [count] rounds, at least one, and returns the answers of the last. See [round]. */
    public fun <T> rounds(count: Int, program: Aggregate<Int>.(Device) -> T): Map<Int, T> {
        require(count > 0) { "the count of rounds is $count: it must be 1 or greater" }
        repeat(count - 1) { round(program) }
        return round(program)
    }

    /** Ends the engine's threads. */
    override fun close(): Unit = engine.close()

    private fun existing(id: Int): Int = id.also { require(it in ids) { "there is no node $it: add it first" } }

    private fun prepare() {
        tick.number++
        tick.time = tick.number * deltaTime
        tick.deltaTime = deltaTime
        tick.links =
            LinkList().also { list ->
                for ((link, values) in newLinks) list.add(link.first, link.second, values.length, values.attenuation)
            }
        links += newLinks.keys
        newLinks.clear()
        ids.forEach(tick.due::add)
    }

    private class LinkValues(val length: Float, val attenuation: Float)

    /** The engine takes `null` for a failure; programs may answer it. */
    private class Answer(val value: Any?)

    /** What all nodes run: the program of the round at hand. */
    private class Program : NodeProgram {
        var body: Aggregate<Int>.(Device) -> Any? = {}

        /** What was thrown, by its description. */
        val failures = HashMap<String, Throwable>()

        override val name: String get() = "test"

        @Suppress("UNCHECKED_CAST")
        override fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any = Answer((aggregate as Aggregate<Int>).body(device))

        override fun describe(failure: Throwable, place: String?): String =
            (if (place == null || place in failure.toString()) "$failure" else "$failure [$place]").also { failures[it] = failure }
    }

    /** Programs of tests take their sensors from the test. */
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
                "${if (name == null) "a runtime" else "the runtime $name"} is not on the class path, which has $names: add " +
                    "collektive-library.jar for the built-in one, or collektive-adapter.jar and Collektive's own jars"
            }
            return provider.runtimes(ViewRule)
        }
    }
}
