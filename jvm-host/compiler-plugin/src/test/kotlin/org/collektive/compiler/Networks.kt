package org.collektive.compiler

import it.unibo.collektive.Collektive
import it.unibo.collektive.aggregate.api.Aggregate
import kotlinx.serialization.json.Json
import org.collektive.runtime.AggregateRuntimes
import org.collektive.testkit.AlignedDevice
import org.collektive.testkit.MailboxDevices
import org.collektive.testkit.Network
import org.collektive.testkit.ReferenceDevice
import org.collektive.testkit.ReferenceDevices
import kotlin.test.assertEquals

/** Creates reference devices that are all linked to each other. If they are [plain], they do not implement `AlignmentStack`. */
internal fun referenceNetwork(vararg ids: Int, plain: Boolean = false) = Network(ReferenceDevices(isAligned = !plain), *ids).apply {
    for (a in ids) for (b in ids) if (a < b) link(a, b)
}

/** The reference device of node 0. */
internal val Network.first get() = device(0) as ReferenceDevice

/** The same device with its `AlignmentStack`. */
internal val Network.firstAligned get() = device(0) as AlignedDevice

/** Runs [program] once on a device without neighbours. Returns its result and the readable paths of its primitives. */
internal fun trace(program: Aggregate<Int>.() -> Any?): Pair<Any?, List<String>> {
    val network = referenceNetwork(0)
    return network.round(program)[0] to network.first.visited
}

/** Compares the neighbours that [program] returns in the second round on some of four devices, which are all linked to each other. */
internal fun assertSeen(compiled: Compilation, program: String, expected: Array<out Pair<Int, Set<Int>>>, plainToo: Boolean = true) {
    for (plain in if (plainToo) listOf(false, true) else listOf(false)) {
        val network = referenceNetwork(0, 1, 2, 3, plain = plain)
        network.round(compiled.program(program))
        val seen = network.round(compiled.program(program))
        for ((id, ids) in expected) assertEquals<Any?>(ids, seen[id], "$program on device $id (plain: $plain)")
    }
}

/** Returns networks of four devices in a row by name: one of reference devices, and one for each kind of device that users run. */
internal fun rows(): Map<String, Network> = mapOf(
    "reference" to ReferenceDevices(),
    WITHOUT_STACK to ReferenceDevices(isAligned = false),
    "in place" to AggregateRuntimes(),
    "mailboxes" to mailboxes(null),
    "mailboxes with JSON" to mailboxes(Json { allowSpecialFloatingPointValues = true }),
).mapValues { Network(it.value, 0, 1, 2, 3).line(0, 1, 2, 3) }

internal const val WITHOUT_STACK = "reference without AlignmentStack"

private fun mailboxes(json: Json?) =
    MailboxDevices(json) { id, mailbox, program -> Collektive(id, mailbox, computeFunction = program)::cycle }
