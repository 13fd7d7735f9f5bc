package org.collektive.engine

import org.collektive.api.Parameters

/**
 * What one tick asks of the engine; filled, used by [Engine.step], and cleared for the next one.
 *
 * Changes apply in the order of the properties, before any round; removing a node removes its links.
 */
public class Tick {
    /** 1 for a session's first tick, then one more each time. */
    public var number: Long = 0

    /** Simulated seconds at this tick. */
    public var time: Double = 0.0

    /** Simulated seconds since the tick before. */
    public var deltaTime: Double = 0.0

    /** Ids of nodes that leave. */
    public val nodesRemoved: IntList = IntList()

    /** Nodes that come. */
    public val nodesAdded: MutableList<NewNode> = ArrayList()

    /** Links that end: sender, receiver, sender, receiver... */
    public val linksRemoved: IntList = IntList()

    /** Links that begin or get new values; must stay as they are until the tick is over. */
    public var links: Links = NoLinks

    /** Nodes that run a round, ascending. */
    public val due: IntList = IntList()

    /** The scene's global data from this tick on; `null`: as before. */
    public var globals: Any? = null

    /** Forgets everything, and keeps the memory. */
    public fun clear() {
        nodesRemoved.clear()
        nodesAdded.clear()
        linksRemoved.clear()
        links = NoLinks
        due.clear()
        globals = null
    }
}

/** A node that comes: [id] 0 or greater and free, with the program that it runs. */
public class NewNode(public val id: Int, public val program: NodeProgram, public val parameters: Parameters)

/** A tick that breaks a rule and was refused before it changed anything; [message] names the tick, the id and the value. */
public class TickRefused(public val tick: Long, message: String) : IllegalArgumentException("tick $tick: $message")
