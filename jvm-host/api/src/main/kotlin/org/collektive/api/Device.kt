package org.collektive.api

import kotlin.random.Random

/** What a program knows of its node beside the sensors. Valid during the node's round. */
public interface Device {
    /** The node's id, 0 or greater. */
    public val id: Int

    /** Simulated seconds at this round. */
    public val time: Double

    /** Simulated seconds since this node's last round that did not fail; of its first round, since the tick before. */
    public val deltaTime: Double

    /** This node's own stream of random numbers, equal in every run with the same seed. A failed round does not wind it back. */
    public val random: Random

    /** The program's parameters, as this node has them. */
    public val parameters: Parameters

    /** The scene's `GlobalData`: a view, to be cast to that type; `null` until the scene has sent one. */
    public val globals: Any?
}
