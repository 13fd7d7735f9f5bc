package org.collektive.spi

/** Runs the rounds of one device by an implementation of the Collektive API. Confined to one thread at a time. */
public interface DeviceRuntime {
    /**
     * Runs one round of [program] and returns its result. Does not change the device's state and messages: [commit] does.
     *
     * @param inbox the links into this device.
     * @param sensors passed on to [program].
     * @throws Throwable whatever [program] throws.
     */
    public fun round(inbox: Inbox, program: RoundProgram, sensors: Any?): Any?

    /** Number of values that the last round sends: one per path, even without neighbours. Walks all paths; avoid it in every round. */
    public val exports: Int

    /** The place where the last round failed with [failure], such as `node 3 at helper > share (Swarm.kt:12)`; `null` when unknown. */
    public fun placeOf(failure: Throwable): String?

    /**
     * Makes the state of the last round current and returns the export of that round.
     *
     * The export stays readable until the first [round] after the next [commit], and beyond that while it is [held][Export.hold].
     */
    public fun commit(): Export
}

/** The links into a device, in ascending order of the senders' ids. */
public interface Inbox {
    /** Number of links. */
    public val size: Int

    /** The senders' ids; its length is [size]. Shared: nobody may change the array. */
    public val ids: Array<Any>

    /** The last export that arrived on link [index]; `null` before the first one, and once it has expired. */
    public fun export(index: Int): Export?

    /** Whether link [index] existed when its export was sent; if not, the receiver reads the export's default. */
    public fun wasKnown(index: Int): Boolean
}

/** The program of one device. */
public fun interface RoundProgram {
    /** Runs one round; [aggregate] is the runtime's `Aggregate`, the receiver of the program. */
    public fun run(aggregate: Any, sensors: Any?): Any?
}

/** Makes the devices of one session and owns the state that they share. */
public interface DeviceRuntimes {
    /** Makes a device without state; [id] is 0 or greater. */
    public fun device(id: Int): DeviceRuntime

    /**
     * Frees shared state that none of [devices] uses; [devices] are all devices of the session. Call it only while no round runs. Cheap
     * when there is nothing to free.
     */
    public fun tidy(devices: List<DeviceRuntime>)
}

/** Decides which values must not outlive a round. Safe on any thread. */
public fun interface SharingRule {
    /** The reason why [value] must not be shared, stored or used as a pivot; `null` when it may. */
    public fun refusal(value: Any?): String?
}
