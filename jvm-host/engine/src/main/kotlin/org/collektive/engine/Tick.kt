package org.collektive.engine

import org.collektive.api.Parameters
import org.collektive.spi.Conversion

/**
 * The input of one tick. Fill it, pass it to [Engine.step], then [clear] and reuse it.
 *
 * The engine applies the changes in the order of the properties, before any round. Removing a node removes its links.
 */
public class Tick {
    /** The tick's number: 1 for a session's first tick, then consecutive. */
    public var number: Long = 0

    /** Simulated time of this tick, in seconds. */
    public var time: Double = 0.0

    /** Simulated seconds since the previous tick, 0 or greater. */
    public var deltaTime: Double = 0.0

    /** New programs, which apply before all other changes; `null` leaves the programs unchanged. */
    public var reload: Reload? = null

    /** Ids of the nodes to remove. */
    public val nodesRemoved: IntList = IntList()

    /** Nodes to add. */
    public val nodesAdded: MutableList<NewNode> = ArrayList()

    /** New parameters of existing nodes. */
    public val nodesChanged: MutableList<NewNode> = ArrayList()

    /** Links to remove, as pairs of ids: sender, receiver. */
    public val linksRemoved: IntList = IntList()

    /** Links to add or update. Must not change until [Engine.step] returns. */
    public var links: Links = NoLinks

    /** Ids of the nodes that run a round, ascending. */
    public val due: IntList = IntList()

    /** The scene's global data, starting with this tick; `null` leaves it unchanged. */
    public var globals: Any? = null

    /** Whether the answer contains the sizes of messages. */
    public var measuresMessages: Boolean = false

    /** Whether the answer contains the metrics of the session. */
    public var measures: Boolean = false

    /** Id of the node to [inspect][Engine.inspect], or -1. */
    public var inspected: Int = -1

    /** Resets everything except [number], [time], [deltaTime], [measuresMessages], [measures] and [inspected]. Keeps the memory. */
    public fun clear() {
        reload = null
        nodesRemoved.clear()
        nodesAdded.clear()
        nodesChanged.clear()
        linksRemoved.clear()
        links = NoLinks
        due.clear()
        globals = null
    }
}

/**
 * A node to add, whose [id] must be unused and 0 or greater, or an existing node with new parameters.
 *
 * @property source the data from which the owner of the engine recreates the node with another [program]; see [Engine.replacements].
 */
public class NewNode(public val id: Int, public val program: NodeProgram, public val parameters: Parameters, public val source: Any? = null)

/**
 * New programs of all nodes.
 *
 * @property replacements see [Engine.replacements].
 * @property conversion converts values of the previous programs.
 */
public class Reload(internal val replacements: List<NewNode>, internal val conversion: Conversion)

/** Thrown when a tick is invalid. Nothing has changed; [message] names the tick, the id and the value. */
public class InvalidTickException(public val tick: Long, message: String) : IllegalArgumentException("tick $tick: $message")
