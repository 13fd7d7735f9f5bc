package org.collektive.api

import kotlin.random.Random

/** The node that runs a program, without its sensor data. It is valid only during the node's round, on the thread that runs the round. */
public interface Device {
    /** The node's id, 0 or greater. */
    public val id: Int

    /** Simulated time of this round, in seconds. */
    public val time: Double

    /** Simulated seconds since this node's last successful round; in its first round, since the previous tick. */
    public val deltaTime: Double

    /** This node's random stream. The same seed gives the same numbers. A failed round does not rewind the stream. */
    public val random: Random

    /** The program's parameters with this node's values. */
    public val parameters: Parameters

    /** The scene's global data as a `GlobalData` view, valid during the round; `null` until the scene sends it. */
    public val globals: Any?

    /**
     * Returns the length in metres of the link from [neighbor], as last sent by the scene.
     *
     * The scene resends a length only when it changes by more than the tolerance of the neighbourhood rule.
     *
     * @throws NoSuchElementException when this node has no link from [neighbor].
     */
    public fun distance(neighbor: Int): Double = throw NoSuchElementException("node $id has no link from node $neighbor")

    /**
     * Returns the attenuation of the link from [neighbor], as last sent by the scene: 0 (clear) or greater.
     *
     * @throws NoSuchElementException when this node has no link from [neighbor].
     */
    public fun attenuation(neighbor: Int): Double = throw NoSuchElementException("node $id has no link from node $neighbor")
}
