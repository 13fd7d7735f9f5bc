package org.collektive.engine

import org.collektive.api.NetworkSnapshot
import org.collektive.api.NodeSnapshot
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.DeviceRuntimes
import java.util.function.LongSupplier

/**
 * One simulation: nodes, links and their rounds.
 *
 * Call it from one thread at a time; rounds run on the engine's own threads. In steady state the engine allocates nothing per tick.
 *
 * @param limitClock the clock, in nanoseconds, against which [step] checks its deadline.
 */
public class Engine @JvmOverloads constructor(
    private val settings: EngineSettings,
    private val runtimes: DeviceRuntimes,
    limitClock: LongSupplier = LongSupplier(System::nanoTime),
) : AutoCloseable {
    // This is declared before `nodes`, because garbage collectors follow the fields in the order of declaration.
    private val order = RoundOrder()
    private val nodes = NodeList()
    private val validator = TickValidator(nodes)
    private val result = TickResult()
    private val isSequential = settings.schedule == Schedule.SEQUENTIAL
    private val clock = Clock()
    private val transmitters = Array(settings.threads) { Transmitter(settings.network, settings.seed, clock) }
    private val roundTask = RoundPool.Task(::runRange)
    private val deliveryTask = RoundPool.Task(::deliverRange)
    private val workTask = RoundPool.Task<() -> Unit> { work, _, _, _, _ -> work() }
    private var turns = IntArray(0)
    private var linkCount = 0
    private var reloadedCount = 0
    private var inspected = -1
    private var inspectedNanos = 0L
    private val runtimesOfNodes = object : AbstractList<DeviceRuntime>() {
        override val size get() = nodes.size
        override fun get(index: Int) = nodes.node(index).runtime
    }

    // The pool is initialised last, because it starts threads.
    private val pool = RoundPool(if (isSequential) 1 else settings.threads, limitClock)

    /** The last tick whose changes were applied; 0 before the first. */
    public val lastTick: Long get() = clock.tick

    /** Wakes the round threads before a tick, so that they are ready when its frame has been read. */
    public fun wake() {
        pool.wake()
    }

    /**
     * Returns a new node for each existing node, in the order of ids, without changing the engine. [create] receives the id and the
     * [NewNode.source] of a node, and returns the new node.
     */
    public fun replacements(create: (Int, Any?) -> NewNode): List<NewNode> =
        List(nodes.size) { create(nodes.keys[it], nodes.node(it).source) }

    /**
     * Applies the changes of [tick], then runs one round of each due node.
     *
     * An exception fails only its own round: the node keeps the state and messages of its last successful round.
     *
     * @param data reads the sensor data and packs the answers; called on the threads that run the rounds.
     * @param deadline end of all rounds, on the clock of the engine's time limits; by default `System.nanoTime()`.
     * @return the outcome, valid until the next call.
     * @throws InvalidTickException when the tick is invalid; nothing has changed.
     * @throws RoundTimeoutException when rounds still run at the deadline; the engine must then be closed.
     */
    public fun step(tick: Tick, data: RoundData, deadline: Long): TickResult {
        check(!pool.isClosed) { "the engine is closed" }
        validator.check(tick, clock.tick + 1)
        result.reset(tick.number, tick.due.size)
        apply(tick, deadline)
        result.nodeCount = nodes.size
        result.linkCount = linkCount
        if (tick.inspected != inspected) inspectedNanos = 0
        inspected = tick.inspected
        if (!isSequential) order.arrange(nodes, linkCount, tick.number)
        runtimes.freeUnused(runtimesOfNodes)
        findDue(tick)
        val begin = System.nanoTime()
        runRounds(data, deadline)
        if (reloadedCount > 0) endFirstRounds()
        if (settings.keepsAnswers) keepAnswers()
        deliver(deadline)
        result.roundNanos = System.nanoTime() - begin
        return result
    }

    /**
     * Runs [work] once on a round thread. [work] must catch the exceptions of users' code. Errors refer to it as [name].
     *
     * @throws RoundTimeoutException when [work] still runs at the [deadline] of [step]; the engine must then be closed.
     */
    public fun run(deadline: Long, name: String, work: () -> Unit) {
        runOnPool(workTask, work, 1, deadline, name)
    }

    /** Returns the state of the node [Tick.inspected] after the last [step], with at most [limit] values, or `null` for an unknown node. */
    public fun inspect(limit: Int): NodeState? = nodes.find(inspected)?.let { NodeState(it.id, inspectedNanos, it.runtime.state(limit)) }

    /**
     * Returns all nodes after the last [step].
     *
     * @param tick the input of that step.
     * @param sensors returns the sensor data of the node `due[index]`.
     */
    public fun snapshot(tick: Tick, sensors: (Int) -> Any): NetworkSnapshot<Any, Any> {
        var due = 0
        return NetworkSnapshot(
            clock.time,
            List(nodes.size) { index ->
                val node = nodes.node(index)
                val isDue = due < tick.due.size && tick.due[due] == node.id
                NodeSnapshot(node.id, if (isDue) sensors(due++) else null, node.answer, node.incoming.snapshot())
            },
        )
    }

    /** Ends the engine's threads: idle ones immediately, busy ones after their round. */
    override fun close() {
        pool.abandon()
    }

    private fun apply(tick: Tick, deadline: Long) {
        clock.tick = tick.number
        clock.time = tick.time
        clock.readsBefore = if (isSequential) tick.number + 1 else tick.number
        clock.deltaTime = tick.deltaTime
        tick.reload?.let { reload(it, deadline) }
        tick.globals?.let { clock.globals = it }
        removeNodes(tick)
        addNodes(tick)
        // A loop over indices does not allocate an iterator.
        for (index in tick.nodesChanged.indices) {
            val change = tick.nodesChanged[index]
            existing(change.id).change(change)
        }
        for (index in 0 until tick.linksRemoved.size / 2) {
            unlink(existing(tick.linksRemoved[2 * index]), existing(tick.linksRemoved[2 * index + 1]))
        }
        val links = tick.links
        for (index in 0 until links.size) {
            val from = existing(links.from(index))
            val to = existing(links.to(index))
            if (to.incoming.put(
                    from,
                    links.length(index),
                    links.attenuation(index),
                    tick.number,
                    validator.place(index),
                    transmitters[0],
                )
            ) {
                from.outgoing.insert(to)
                linkCount++
                order.linkChanged()
                if (settings.network.isIdeal && from.last != null) result.network.sent++
            }
        }
    }

    private fun reload(reload: Reload, deadline: Long) {
        clock.globals = null
        reload.replacements.forEachIndexed { index, new -> nodes.node(index).reload(new) }
        reloadedCount = nodes.size
        // Runs on a round thread, because the conversion calls users' code.
        run(deadline, "the conversion of stored values") { result.storedValues = runtimes.convert(runtimesOfNodes, reload.conversion) }
    }

    private fun endFirstRounds() {
        for (index in 0 until result.size) {
            val node = result.node(index)
            if (!node.isReloaded) continue
            node.endFirstRound(hasFailed = result.failure(index) != null)
            reloadedCount--
        }
    }

    private fun keepAnswers() {
        for (index in 0 until result.size) result.answer(index)?.let { result.node(index).answer = it }
    }

    private fun removeNodes(tick: Tick) {
        if (tick.nodesRemoved.size == 0) return
        for (removed in 0 until tick.nodesRemoved.size) {
            val node = existing(tick.nodesRemoved[removed])
            if (node.isReloaded) reloadedCount--
            for (index in node.incoming.size - 1 downTo 0) unlink(node.incoming.node(index), node)
            for (index in node.outgoing.size - 1 downTo 0) unlink(node, node.outgoing.node(index))
        }
        nodes.removeIf(validator::removes)
        order.removeIf(validator::removes)
    }

    private fun addNodes(tick: Tick) {
        if (tick.nodesAdded.isEmpty()) return
        val added = tick.nodesAdded.map {
            Node(it, runtimes.device(it.id), clock, settings.seed, settings.network.isIdeal)
        }
        nodes.insertAll(added.sortedBy(Node::id))
        order.addAll(added)
    }

    private fun unlink(from: Node, to: Node) {
        to.incoming.removeLink(from)
        from.outgoing.remove(to)
        linkCount--
        order.linkChanged()
    }

    private fun existing(id: Int): Node = nodes.find(id) ?: error("node $id is missing after validation")

    private fun findDue(tick: Tick) {
        val due = tick.due
        var at = 0
        for (index in 0 until due.size) {
            while (nodes.keys[at] != due[index]) at++
            result.due(index, nodes.node(at))
        }
    }

    /** Returns the index of the due node whose round is number [turn]. The sequential schedule runs them in id order. */
    private fun indexOf(turn: Int) = if (isSequential) turn else turns[turn]

    private fun runRounds(data: RoundData, deadline: Long) {
        if (!isSequential) turns = order.turns(result)
        runOnPool(roundTask, data, result.size, deadline)
        result.countFailures()
    }

    /** Moves sent messages to the links. In an ideal network, receivers read exports directly, so this only counts messages. */
    private fun deliver(deadline: Long) {
        val counts = result.network
        if (settings.network.isIdeal) {
            val allSent = result.size == nodes.size && result.failureCount == 0
            if (allSent) counts.sent += linkCount else countSent(counts)
            return
        }
        runOnPool(deliveryTask, transmitters, nodes.size, deadline)
        for (transmitter in transmitters) {
            counts.add(transmitter.counts)
            transmitter.counts.clear()
        }
    }

    private fun countSent(counts: NetworkCounts) {
        for (index in 0 until result.size) if (result.failure(index) == null) counts.sent += result.node(index).outgoing.size
    }

    @Suppress("UNUSED_PARAMETER") // RoundPool.Task fixes the signature.
    private fun deliverRange(transmitters: Array<Transmitter>, thread: RoundThread, worker: Int, begin: Int, end: Int) {
        for (index in begin until end) {
            if (pool.isClosed) return
            val incoming = nodes.node(index).incoming
            incoming.collect(transmitters[worker])
            incoming.advance(transmitters[worker])
        }
    }

    private fun <T> runOnPool(task: RoundPool.Task<T>, input: T, count: Int, deadline: Long, work: String = "rounds") {
        val range = if (isSequential) count else (count / (settings.threads * RANGES_PER_THREAD)).coerceIn(MIN_RANGE, MAX_RANGE)
        if (pool.run(task, input, count, range, deadline)) return
        // Abandons the pool even if memory is too low for the dump.
        val dump = try {
            pool.dump()
        } finally {
            pool.abandon()
        }
        throw RoundTimeoutException(clock.tick, work, dump)
    }

    private fun runRange(data: RoundData, thread: RoundThread, worker: Int, begin: Int, end: Int) {
        var prefetched = begin
        for (turn in begin until end) {
            if (pool.isClosed) return
            if (turn == prefetched && !isSequential) {
                prefetched = minOf(turn + PREFETCHED_ROUNDS, end)
                thread.prefetched += order.prefetch(turn, prefetched)
            }
            val index = indexOf(turn)
            val node = result.node(index)
            thread.begin(node)
            val isInspected = node.id == inspected
            val start = if (isInspected) System.nanoTime() else 0
            try {
                result.answered(index, answer(node, data, worker, index))
            } catch (failure: Throwable) {
                // Any exception of a program, including errors of the JVM, fails only its round.
                result.failed(index, describe(node, failure))
            }
            if (isInspected) inspectedNanos = System.nanoTime() - start
            thread.end()
        }
    }

    /** Runs the round of [node] and packs its answer; then commits its state and messages. */
    private fun answer(node: Node, data: RoundData, worker: Int, index: Int): Any {
        if (isSequential) node.incoming.collect(transmitters[worker])
        node.incoming.advance(transmitters[worker])
        val answer = node.round(data.sensors(worker, index)) ?: throw InvalidAnswerException("the program returned null")
        data.pack(worker, index, answer)?.let { throw InvalidAnswerException(it) }
        node.send(node.runtime.commit(), clock.tick, clock.time)
        return answer
    }

    /** Describes [failure] on the round's thread, because this may call user code of the exception. */
    private fun describe(node: Node, failure: Throwable): String = try {
        node.program.describe(failure, node.runtime.placeOf(failure))
    } catch (_: Throwable) {
        "${failure.javaClass.name} (no details: the exception's own code failed, or memory is exhausted)"
    }

    private companion object {
        // Small ranges balance the threads at the end of a tick; large ranges need fewer atomic operations.
        const val RANGES_PER_THREAD = 32
        const val MIN_RANGE = 16
        const val MAX_RANGE = 128

        // This is large enough for the cache misses of the rounds to overlap, but small enough for the L1 cache.
        const val PREFETCHED_ROUNDS = 64
    }
}

/** A node's stored values with their paths, and the duration of its last round since the inspection began, or 0 if it had no round. */
public class NodeState(public val id: Int, public val roundNanos: Long, public val values: List<Pair<String, Any?>>)

/** Thrown when the answer of a program cannot be written; the message states the reason. */
public class InvalidAnswerException(message: String) : IllegalStateException(message)

/** Thrown when rounds or other [work] still run at the deadline; [threads] is a dump of their stacks. */
public class RoundTimeoutException(tick: Long, work: String, public val threads: String) :
    IllegalStateException("tick $tick: $work did not finish within the time limit")
