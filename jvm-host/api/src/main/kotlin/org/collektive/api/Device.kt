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
}
