package org.collektive.engine

import org.collektive.runtime.DeviceRuntime
import org.collektive.runtime.DeviceRuntimes
import org.collektive.runtime.RoundProgram
import it.unibo.collektive.aggregate.api.Aggregate

/**
 * Nodes, links and their rounds: one simulation.
 *
 * All calls come from one thread at a time; rounds run on threads of the engine's own. No allocation per tick in steady state but
 * what programs do.
 */
public class Engine(private val settings: EngineSettings, private val runtimes: DeviceRuntimes) : AutoCloseable {
    private val nodes = Peers()
    private val validator = TickValidator(nodes)
    private val clock = Clock()
    private val result = TickResult()
    private val pool = RoundPool(if (settings.schedule == Schedule.SEQUENTIAL) 1 else settings.threads)
    private val rounds = Array(settings.threads) { Round(it) }
    private val task = RoundPool.Task(::runRange)
    private var sensors = SensorSource { _, _ -> null }
    private var lastTick = 0L
    private val runtimesOfNodes = object : AbstractList<DeviceRuntime>() {
        override val size get() = nodes.size
        override fun get(index: Int) = nodes.node(index).runtime
    }

    /** Nodes that there are. */
    public val nodeCount: Int get() = nodes.size

    /** Directed links that there are. */
    public var linkCount: Int = 0
        private set

    /**
     * Applies the changes of [tick], then runs one round of each due node.
     *
     * A round that throws costs its node this round only: state and messages stay those of its last good one.
     *
     * @param sensors asked once per due node, on the thread that runs its round.
     * @param deadline in terms of `System.nanoTime()`.
     * @throws TickRefused when the tick breaks a rule; nothing has changed then.
     * @throws RoundsNotFinished when rounds still ran at the deadline; this engine can only be closed then.
     */
    public fun step(tick: Tick, sensors: SensorSource, deadline: Long): TickResult {
        check(!pool.isClosed) { "the engine is closed" }
        validator.check(tick, lastTick + 1)
        apply(tick)
        runtimes.tidy(runtimesOfNodes)
        findDue(tick)
        runRounds(sensors, deadline)
        return result
    }

    /**
     * Turns the answer of the due node [index] of the last tick into a failure: for answers that turn out to be useless after the rounds.
     * The node goes back to the state and messages before the tick.
     */
    public fun reject(index: Int, reason: Throwable) {
        val node = result.node(index)
        check(result.failure(index) == null) { "the round of node ${node.id} has failed already" }
        node.runtime.rollback()
        node.sentAt = node.sentBefore
        result.failed(index, reason)
        result.failureCount++
    }

    /** Ends the engine's threads, those in a round when it ends. */
    override fun close() {
        pool.abandon()
    }

    private fun apply(tick: Tick) {
        lastTick = tick.number
        clock.time = tick.time
        clock.deltaTime = tick.deltaTime
        tick.globals?.let { clock.globals = it }
        removeNodes(tick)
        addNodes(tick)
        for (index in 0 until tick.linksRemoved.size step 2) {
            unlink(existing(tick.linksRemoved[index]), existing(tick.linksRemoved[index + 1]))
        }
        val links = tick.links
        for (index in 0 until links.size) {
            val from = existing(links.from(index))
            val to = existing(links.to(index))
            if (to.incoming.put(from, links.length(index), links.attenuation(index), tick.number)) {
                from.outgoing.insert(to)
                linkCount++
            }
        }
    }

    private fun removeNodes(tick: Tick) {
        if (tick.nodesRemoved.size == 0) return
        for (removed in 0 until tick.nodesRemoved.size) {
            val node = existing(tick.nodesRemoved[removed])
            for (index in node.incoming.size - 1 downTo 0) unlink(node.incoming.node(index), node)
            for (index in node.outgoing.size - 1 downTo 0) unlink(node, node.outgoing.node(index))
        }
        nodes.removeIf(validator::removes)
    }

    private fun addNodes(tick: Tick) {
        if (tick.nodesAdded.isEmpty()) return
        val added = tick.nodesAdded.map {
            Node(it.id, it.program, it.parameters, runtimes.device(it.id), clock, settings.seed)
        }
        nodes.insertAll(added.sortedBy(Node::id))
    }

    private fun unlink(from: Node, to: Node) {
        to.incoming.removeLink(from)
        from.outgoing.remove(to)
        linkCount--
    }

    private fun existing(id: Int): Node = nodes.find(id) ?: error("node $id vanished after validation")

    private fun findDue(tick: Tick) {
        val due = tick.due
        result.reset(due.size)
        var at = 0
        for (index in 0 until due.size) {
            while (nodes.node(at).id != due[index]) at++
            result.due(index, nodes.node(at))
        }
    }

    private fun runRounds(sensors: SensorSource, deadline: Long) {
        this.sensors = sensors
        val begin = System.nanoTime()
        val count = result.size
        val isSequential = settings.schedule == Schedule.SEQUENTIAL
        val range = if (isSequential) count else (count / (settings.threads * RANGES_PER_THREAD)).coerceIn(MIN_RANGE, MAX_RANGE)
        if (!pool.run(task, count, range, deadline)) {
            val dump = pool.dump()
            pool.abandon()
            throw RoundsNotFinished(lastTick, dump)
        }
        for (index in 0 until count) {
            if (result.failure(index) != null) result.failureCount++ else if (!isSequential) commit(result.node(index))
        }
        result.roundNanos = System.nanoTime() - begin
    }

    private fun runRange(thread: RoundThread, worker: Int, begin: Int, end: Int) {
        val isSequential = settings.schedule == Schedule.SEQUENTIAL
        val round = rounds[worker]
        for (index in begin until end) {
            if (pool.isClosed) return
            val node = result.node(index)
            thread.node = node.id
            try {
                val answer = round.run(node, index)
                if (isSequential) commit(node)
                result.answered(index, answer)
            } catch (failure: Throwable) {
                // Whatever a program throws, errors of the JVM included, is the failure of its round.
                result.failed(index, failure)
            }
            thread.node = -1
        }
    }

    private fun commit(node: Node) {
        node.runtime.commit()
        node.sentBefore = node.sentAt
        node.sentAt = lastTick
    }

    /** The round that one thread runs, made once. */
    private inner class Round(private val worker: Int) : RoundProgram {
        private var node: Node? = null
        private var index = 0

        fun run(node: Node, index: Int): Any {
            this.node = node
            this.index = index
            return node.runtime.round(node.incoming, this)
                ?: throw IllegalStateException("the program returned null instead of its actuator data")
        }

        override fun run(aggregate: Aggregate<Int>): Any? {
            val node = checkNotNull(node)
            return node.program.round(aggregate, sensors.sensors(worker, index), node)
        }
    }

    private companion object {
        // Ranges small enough to share uneven rounds among threads, large enough that taking one costs nothing.
        const val RANGES_PER_THREAD = 8
        const val MIN_RANGE = 16
        const val MAX_RANGE = 512
    }
}

/** Rounds that still ran when the limit passed; [threads] tells what they were doing. */
public class RoundsNotFinished(tick: Long, public val threads: String) :
    IllegalStateException("tick $tick: rounds did not finish within the limit")
