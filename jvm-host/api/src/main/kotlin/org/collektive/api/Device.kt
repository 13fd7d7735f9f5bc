package org.collektive.api

import kotlin.random.Random

/** The node that a program runs on, apart from its sensors. Valid only during the node's round, on the thread that runs it. */
public interface Device {
    /** The node's id, 0 or greater. */
    public val id: Int

    /** Simulated time of this round, in seconds. */
    public val time: Double

    /** Simulated seconds since this node's last successful round; in its first round, since the previous tick. */
    public val deltaTime: Double

    /** This node's random stream. Runs with the same seed draw the same numbers. A failed round does not rewind it. */
    public val random: Random

    /** The program's parameters with this node's values. */
    public val parameters: Parameters

    /** The scene's global data: a view to cast to `GlobalData`, valid during the round. `null` until the scene has sent it. */
    public val globals: Any?

    /**
     * The length in metres of the link from [neighbor], as the scene last gave it, to within the rule's tolerance.
     *
     * @throws NoSuchElementException when there is no such link.
     */
    public fun distance(neighbor: Int): Double = throw NoSuchElementException("node $id has no link from node $neighbor")

    /**
     * The attenuation of the link from [neighbor], as the scene last gave it: 0 (clear) or greater.
     *
     * @throws NoSuchElementException when there is no such link.
     */
    public fun attenuation(neighbor: Int): Double = throw NoSuchElementException("node $id has no link from node $neighbor")
}
