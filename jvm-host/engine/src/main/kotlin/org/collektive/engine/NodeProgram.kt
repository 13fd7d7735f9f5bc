package org.collektive.engine

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.api.Device

/** A program as the engine calls it; used by many threads at once. */
public interface NodeProgram {
    /** What errors call it. */
    public val name: String

    /** Runs one round of [device] on [sensors]; the result must not be `null`. */
    public fun round(aggregate: Aggregate<Int>, sensors: Any?, device: Device): Any?
}

/** Gives the sensor data of a tick. */
public fun interface SensorSource {
    /** The data of the node `due[index]`, for use on the thread [worker] (0 until [EngineSettings.threads]) until its next call. */
    public fun sensors(worker: Int, index: Int): Any?
}
