package org.collektive.runtime

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.impl.ProgramPlace

/** What the engine needs of an implementation of the Collektive API: the rounds of one device. One thread at a time. */
public interface DeviceRuntime {
    /**
     * Runs one round. State and messages stay as they were until [commit], whether [program] returns or throws.
     *
     * @param inbox the links into this device.
     */
    public fun round(inbox: Inbox, program: RoundProgram): Any?

    /** How many values the last round sends, one per place in the program, whether there are neighbours or not. Not for every round. */
    public val exports: Int

    /** Where in the program [failure], by which the last round ended, came up; `null` when that is not known. */
    public fun placeOf(failure: Throwable): ProgramPlace?

    /**
     * Makes the state of the last round the valid one and returns what that round sends.
     *
     * The result may be read until the first [round] after the next [commit], and longer while someone [holds][Export.hold] it.
     */
    public fun commit(): Export
}

/** The links into a device, ascending by the sender's id. */
public interface Inbox {
    /** How many links there are. */
    public val size: Int

    /** The senders' ids, exactly [size]; shared, never changed in place. */
    public val ids: Array<Any>

    /** What link [index] brought last; `null`: nothing yet, or nothing that is valid still. */
    public fun export(index: Int): Export?

    /** Whether link [index] was there when its export was sent; if not, it gets the export's default. */
    public fun wasKnown(index: Int): Boolean
}

/** A program, ready to run in one round. */
public fun interface RoundProgram {
    /** Runs the round of [aggregate]'s device. */
    public fun run(aggregate: Aggregate<Int>): Any?
}

/** Makes the devices of one session and owns what they share. */
public interface DeviceRuntimes {
    /** Makes the device [id] (0 or greater), without state. */
    public fun device(id: Int): DeviceRuntime

    /** Frees what no device uses any more; [devices] are all that live. Between rounds only, cheap when there is nothing to do. */
    public fun tidy(devices: List<DeviceRuntime>)
}

/** Decides which values must not leave a round. */
public fun interface SharingRule {
    /** Why [value] must be neither shared, nor kept, nor used as a pivot; `null` when it may. */
    public fun refusal(value: Any?): String?
}
