package org.collektive.runtime

import it.unibo.collektive.Collektive
import it.unibo.collektive.aggregate.AlignmentClashException
import it.unibo.collektive.path.tokens
import kotlinx.serialization.json.Json
import org.collektive.testkit.MailboxDevices
import org.collektive.testkit.Network
import org.collektive.testkit.RandomPrograms
import org.collektive.testkit.ReferenceDevice
import org.collektive.testkit.ReferenceDevices
import org.junit.jupiter.api.Test
import java.util.SortedSet
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Creates devices with mailboxes, and passes each to [use]. Their messages are objects, or texts if [json] is given. */
internal fun mailboxes(json: Json?, use: (Collektive<Int, Any?>) -> Unit = {}) = MailboxDevices(json) { id, mailbox, program ->
    Collektive(id, mailbox, computeFunction = program).also(use)::cycle
}

/** Compares all kinds of devices with [ReferenceDevices], on random programs, random graphs that change, and failing rounds. */
class RoutesTest {
    private val values = HashSet<Any?>()
    private var rounds = 0
    private var clashes = 0
    private var nextId = 0

    @Test
    fun `every route returns, stores and sends the same values as the reference`() {
        repeat(120, ::compare)
        assertTrue(
            rounds > 5000 && clashes in 1..rounds / 3 && values.size > 200,
            "$rounds rounds, $clashes clashes, ${values.size} results",
        )
    }

    private fun compare(seed: Int) {
        nextId = 0
        val random = Random(seed)
        val devices = HashMap<Int, Collektive<Int, Any?>>()
        val reference = Network(ReferenceDevices(isAligned = false))
        val others = mapOf(
            "reference with AlignmentStack" to Network(ReferenceDevices()),
            "in place" to Network(AggregateRuntimes()),
            "in place, in parallel" to Network(AggregateRuntimes(), isParallel = true),
            "mailboxes" to Network(mailboxes(null) { devices[it.localId] = it }),
            "mailboxes with JSON" to Network(mailboxes(Json)),
        )
        val programs = RandomPrograms(random).let { source -> List(2) { source.next() } }
        repeat(25) { step ->
            for (change in changes(random, reference.ids.toSortedSet())) (others.values + reference).forEach(change)
            val due = reference.ids.filter { random.nextInt(5) != 0 }
            val program = programs[if (random.nextInt(5) == 0) 1 else 0]
            val expected = reference.outcomes(due, program)
            for ((route, network) in others) {
                val seen = network.outcomes(due, program)
                assertEquals(expected.mapValues(::describe), seen.mapValues(::describe), "$route, seed $seed, step $step")
            }
            for (id in reference.ids) {
                val state = devices.getValue(id).state.mapKeys { it.key.tokens }
                assertEquals((reference.device(id) as ReferenceDevice).state, state, "state of device $id, seed $seed")
            }
            rounds += due.size
            clashes += expected.values.count { it.exceptionOrNull() is AlignmentClashException }
            values.addAll(expected.values.map { it.getOrNull() })
        }
    }

    /** Returns random changes of nodes and links. A new node sometimes gets the id of a removed one. */
    private fun changes(random: Random, ids: SortedSet<Int>): List<(Network) -> Unit> = buildList {
        while (ids.size < 2 || random.nextInt(8) == 0) {
            val added = nextId++
            ids += added
            add { it.add(added) }
        }
        if (random.nextInt(10) == 0) {
            val removed = ids.random(random)
            add { it.remove(removed) }
            if (random.nextBoolean()) add { it.add(removed) } else ids -= removed
        }
        for (from in ids) {
            for (to in ids) {
                if (from == to || random.nextInt(4) != 0) continue
                if (random.nextInt(3) == 0) add { it.unlinkOneWay(from, to) } else add { it.linkOneWay(from, to) }
            }
        }
    }

    private fun describe(entry: Map.Entry<Int, Result<Any?>>): Any? =
        entry.value.fold({ it }, { "${it::class.simpleName}: ${if (it is AlignmentClashException) it.path.tokens else it.message}" })
}
