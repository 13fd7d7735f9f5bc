package org.collektive.spi

/** Runs the rounds of one device on an implementation of the Collektive API. Not thread-safe: call it from one thread at a time. */
public interface DeviceRuntime {
    /**
     * Runs one round of [program] and returns its result. Only [commit] changes the device's state and messages.
     *
     * @param inbox the links into this device.
     * @param sensors the sensor data to pass to [program].
     * @throws Throwable the exception that [program] throws.
     */
    public fun round(inbox: Inbox, program: RoundProgram, sensors: Any?): Any?

    /**
     * Number of values that the last round sends, one per path, even without neighbours. Reading it is expensive, because it visits all
     * paths.
     */
    public val exports: Int

    /**
     * Returns the place where the last round failed with [failure], such as `node 3 at helper > share (Swarm.kt:12)`, or `null` if
     * unknown.
     */
    public fun placeOf(failure: Throwable): String?

    /**
     * Makes the state of the last round current and returns the export of that round.
     *
     * The export remains readable until the first [round] after the next [commit], and longer while it is [retained][Export.retain].
     */
    public fun commit(): Export

    /** Returns at most [limit] stored values with their paths, as text. Call it only while no round runs. The default returns nothing. */
    public fun state(limit: Int): List<Pair<String, Any?>> = emptyList()

    /**
     * Removes the state, and the messages that receivers have not read. Call it only while no round runs.
     *
     * @throws UnsupportedOperationException when this runtime does not support new programs.
     */
    public fun forget(): Unit = throw UnsupportedOperationException("this runtime cannot replace programs")
}

/** The links into a device, in ascending order of the senders' ids. */
public interface Inbox {
    /** Number of links. */
    public val size: Int

    /** The senders' ids, [size] in number. The array is shared, so do not modify it. */
    public val ids: Array<Any>

    /** Returns the last export that arrived on link [index], or `null` before the first one and after it has expired. */
    public fun export(index: Int): Export?

    /** Returns whether link [index] existed when its export was sent. Otherwise, the receiver reads the default value of the export. */
    public fun wasKnown(index: Int): Boolean
}

/** The program of one device. */
public fun interface RoundProgram {
    /** Runs one round; [aggregate] is the runtime's `Aggregate`, the receiver of the program. */
    public fun run(aggregate: Any, sensors: Any?): Any?
}

/** Creates the devices of one session and owns the state that they share. */
public interface DeviceRuntimes {
    /** Creates a device without state; [id] is 0 or greater. */
    public fun device(id: Int): DeviceRuntime

    /**
     * Frees the shared state that no device uses any more. [devices] are all devices of the session.
     *
     * Call it only while no round runs. It is cheap if nothing can be freed.
     */
    public fun freeUnused(devices: List<DeviceRuntime>)

    /**
     * Applies [conversion] to all values that [devices] have stored or sent, and to the pivots of their paths. Removes values that are
     * lost, and all values at a path with a lost pivot. [devices] are all devices of the session.
     *
     * Call it only while no round runs. The default implementation removes everything.
     */
    public fun convert(devices: List<DeviceRuntime>, conversion: Conversion): StoredValues {
        devices.forEach(DeviceRuntime::forget)
        return StoredValues(0, 0)
    }
}

/** Decides which values must not be kept after a round. Thread-safe. */
public fun interface SharingRule {
    /** Returns the reason why [value] must not be shared, stored or used as a pivot, or `null` if it is allowed. */
    public fun refusal(value: Any?): String?
}
