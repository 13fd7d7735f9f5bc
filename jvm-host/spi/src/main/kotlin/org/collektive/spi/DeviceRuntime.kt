package org.collektive.spi

/** The rounds of one device, run by an implementation of the Collektive API. One thread at a time. */
public interface DeviceRuntime {
    /**
     * Runs one round of [program] and returns its result. State and messages stay as they were until [commit], whether the program
     * returns or throws.
     *
     * @param inbox the links into this device.
     * @param sensors goes to [program] as it is.
     * @throws Throwable whatever [program] throws.
     */
    public fun round(inbox: Inbox, program: RoundProgram, sensors: Any?): Any?

    /** Number of values that the last round sends, one per path, with or without neighbours. Walks all of them: not for every round. */
    public val exports: Int

    /** Where in the program the last round failed with [failure], `node 3 at helper > share (Swarm.kt:12)`; `null` when unknown. */
    public fun placeOf(failure: Throwable): String?

    /**
     * Makes the state of the last round the valid one and returns what that round sends.
     *
     * The result stays readable until the first [round] after the next [commit], and longer while somebody [holds][Export.hold] it.
     */
    public fun commit(): Export
}

/** The links into a device, ascending by the sender's id. */
public interface Inbox {
    /** Number of links. */
    public val size: Int

    /** The senders' ids, exactly [size] of them; shared, never changed in place. */
    public val ids: Array<Any>

    /** What link [index] brought last; `null` before its first message, and when that is no longer valid. */
    public fun export(index: Int): Export?

    /** Whether link [index] existed when its export was sent; if not, it gets the export's default. */
    public fun wasKnown(index: Int): Boolean
}

/** The program of one device. */
public fun interface RoundProgram {
    /** Runs one round; [aggregate] is the receiver that the device's runtime gives its programs. */
    public fun run(aggregate: Any, sensors: Any?): Any?
}

/** Makes the devices of one session and owns what they share. */
public interface DeviceRuntimes {
    /** Makes the device [id] (0 or greater), without state. */
    public fun device(id: Int): DeviceRuntime

    /** Frees what none of [devices], which are all there are, uses any more. Between rounds only; cheap when there is nothing to free. */
    public fun tidy(devices: List<DeviceRuntime>)
}

/** Decides which values must not leave a round. Threads: any. */
public fun interface SharingRule {
    /** Why [value] must be neither shared, nor kept, nor used as a pivot; `null` when it may. */
    public fun refusal(value: Any?): String?
}
