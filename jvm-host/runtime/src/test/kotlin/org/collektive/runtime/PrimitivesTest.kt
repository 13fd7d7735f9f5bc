package org.collektive.runtime

import it.unibo.collektive.aggregate.AlignmentClashException
import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.exchange
import it.unibo.collektive.aggregate.api.exchanging
import it.unibo.collektive.aggregate.api.mapNeighborhood
import it.unibo.collektive.aggregate.api.neighborhood
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.aggregate.api.sharing
import it.unibo.collektive.aggregate.ids
import it.unibo.collektive.aggregate.toMap
import it.unibo.collektive.aggregate.values
import it.unibo.collektive.networking.OutboundEnvelope.SharedData
import it.unibo.collektive.path.FullPath
import it.unibo.collektive.path.Path
import org.collektive.alignment.popToken
import org.collektive.alignment.project
import org.collektive.alignment.pushToken
import org.collektive.testkit.Network
import org.junit.jupiter.api.Test
import java.util.concurrent.CompletableFuture
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertNull
import kotlin.test.assertTrue

class PrimitivesTest {
    private fun network(vararg ids: Int) = Network(AggregateRuntimes(), *ids)

    @Test
    fun `neighboring returns what aligned neighbours sent in their last round`() {
        val network = network(1, 2, 3).line(1, 2, 3)
        val first = network.round { neighboring(localId * 10).all.toMap() }
        assertEquals(mapOf(1 to 10), first[1], "the first round must receive no messages")
        val second = network.round { neighboring(localId * 100).all.toMap() }
        assertEquals(mapOf(1 to 10, 3 to 30, 2 to 200), second[2])
        assertEquals(mapOf(2 to 20, 1 to 100), second[1])
    }

    @Test
    fun `links are directed`() {
        val network = network(1, 2).apply { linkOneWay(1, 2) }
        network.round { neighborhood().neighbors.ids.list }
        assertEquals(mapOf<Int, Any?>(1 to emptyList<Int>(), 2 to listOf(1)), network.round { neighborhood().neighbors.ids.list })
    }

    @Test
    fun `neighbours on another path are absent, not defaulted`() {
        val network = network(1, 2, 3).line(1, 2, 3)
        val program: Aggregate<Int>.() -> Any? = { alignedOn(localId == 3) { neighboring(localId).all.values.list } }
        network.round(program)
        assertEquals(mapOf<Int, Any?>(1 to listOf(2, 1), 2 to listOf(1, 2), 3 to listOf(3)), network.round(program))
    }

    @Test
    fun `pivots are compared by equals, null and data classes included`() {
        data class Key(val name: String, val number: Int)
        val network = network(1, 2).line(1, 2)
        val program: Aggregate<Int>.() -> Any? = {
            alignedOn(null) { alignedOn(Key("a", 1)) { neighboring(localId).neighbors.values.list } }
        }
        network.round(program)
        assertEquals(mapOf<Int, Any?>(1 to listOf(2), 2 to listOf(1)), network.round(program))
    }

    @Test
    fun `a field from an earlier round is restricted to the aligned neighbours on any thread`() {
        val network = network(1, 2).line(1, 2)
        var isTwoInside = true
        val program: Aggregate<Int>.() -> Any? = {
            alignedOn(localId == 1 || isTwoInside) {
                val now = neighboring(localId)
                val depth = pushToken(this, "kept")
                evolving<List<Field<Int, Int>>, Any?>(emptyList()) { old ->
                    listOf(now).yielding { old.map { project(it, "old", true)?.neighbors?.ids?.list } }
                }.also { popToken(this, depth) }
            }
        }
        val rounds = List(4) {
            isTwoInside = it < 2
            CompletableFuture.supplyAsync({ network.round(program)[1] }) { round -> Thread(round).start() }.join()
        }
        assertEquals<Any?>(listOf(emptyList<Int>()), rounds.last())
    }

    @Test
    fun `evolve stores its value from round to round`() {
        val network = network(1)
        assertEquals(listOf(1, 2, 3), List(3) { network.round { evolve(0) { it + 1 } }[1] })
    }

    @Test
    fun `evolving returns another value than it stores`() {
        val network = network(1)
        assertEquals(listOf("1", "2"), List(2) { network.round { evolving(0) { (it + 1).yielding { toString() } } }[1] })
    }

    @Test
    fun `a path that is not visited loses its state and its messages`() {
        val network = network(1, 2).line(1, 2)
        val visiting: Aggregate<Int>.() -> Any? = {
            val count = alignedOn("count") { evolve(0) { it + 1 } }
            count to alignedOn("near") { neighboring(localId).neighbors.values.list }
        }
        network.round(visiting)
        assertEquals(2 to listOf(2), network.round(visiting)[1])
        network.round { "elsewhere" }
        assertEquals(1 to emptyList<Int>(), network.round(visiting)[1])
    }

    @Test
    fun `null can be stored and shared`() {
        val network = network(1, 2).line(1, 2)
        val program: Aggregate<Int>.() -> Any? = {
            val kept = alignedOn("kept") { evolve<String?>("initial") { if (it == null) "was null" else null } }
            kept to alignedOn("sent") { neighboring(null as String?).neighbors.values.list }
        }
        assertEquals(null to emptyList<Any?>(), network.round(program)[1])
        assertEquals("was null" to listOf<Any?>(null), network.round(program)[1])
    }

    @Test
    fun `share can count hops`() {
        val network = network(0, 1, 2, 3).line(0, 1, 2, 3)
        val hops: Aggregate<Int>.() -> Any? = {
            share(99) { seen -> if (localId == 0) 0 else (seen.neighbors.values.list.minOrNull() ?: 98) + 1 }
        }
        repeat(5) { network.round(hops) }
        assertEquals(mapOf<Int, Any?>(0 to 0, 1 to 1, 2 to 2, 3 to 3), network.round(hops))
    }

    @Test
    fun `the local value of an exchange is the stored one, at first initial`() {
        val network = network(1)
        val program: Aggregate<Int>.() -> Any? = { sharing(5) { seen -> (seen.local.value + 1).yielding { seen.local.value } } }
        assertEquals(listOf(5, 6, 7), List(3) { network.round(program)[1] })
    }

    @Test
    fun `exchange sends each neighbour its own value, and sends new neighbours the local one`() {
        val network = network(1, 2, 3).line(1, 2)
        val program: Aggregate<Int>.() -> Any? = {
            exchanging("") { seen ->
                val toSend = seen.map { "${it.id} from $localId" }
                toSend.yielding { seen.neighbors.toMap() }
            }
        }
        network.round(program)
        network.round(program)
        network.line(1, 3)
        val third = network.round(program)
        assertEquals(mapOf(1 to "2 from 1"), third[2])
        assertEquals(mapOf(1 to "1 from 1"), third[3], "node 3 was not a neighbour when node 1 sent, so it must get the local value")
        assertEquals(mapOf(1 to "3 from 1"), network.round(program)[3])
    }

    @Test
    fun `each neighbour gets its own value even if equals says that it is the local one`() {
        class Note(val receiver: Int) {
            override fun equals(other: Any?) = other is Note

            override fun hashCode() = 0
        }
        for (network in listOf(network(1, 2, 3), Network(mailboxes(null), 1, 2, 3))) {
            network.line(1, 2, 3)
            val seen = List(3) {
                network.round {
                    exchanging(Note(0)) { notes ->
                        notes.map { Note(it.id) }.yielding { notes.neighbors.values.list.map { it.receiver } }
                    }
                }
            }
            assertEquals(mapOf(1 to listOf(1), 2 to listOf(2, 2), 3 to listOf(3)), seen.last())
        }
    }

    @Test
    fun `a new node with an old id starts without state and messages`() {
        val network = network(1, 2).line(1, 2)
        val program: Aggregate<Int>.() -> Any? = {
            exchange("") { seen -> seen.map { "${it.id} from $localId" } }.let { "" }
        }
        repeat(2) { network.round(program) }
        network.remove(2)
        network.add(2)
        network.line(1, 2)
        val seen = network.round { exchanging("") { seen -> seen.yielding { seen.neighbors.toMap() } } }
        assertEquals(mapOf(1 to "1 from 1"), seen[2])
    }

    @Test
    fun `mapNeighborhood maps ids, this device's included`() {
        val network = network(1, 2).line(1, 2)
        val program: Aggregate<Int>.() -> Any? = { mapNeighborhood { it * 2 }.all.toMap() }
        network.round(program)
        assertEquals(mapOf(2 to 4, 1 to 2), network.round(program)[1])
    }

    @Test
    fun `primitives inside map are aligned on the entry's id`() {
        val network = network(1, 2, 3).line(1, 2, 3)
        val program: Aggregate<Int>.() -> Any? = {
            val near = alignedOn("near") { exchanging(0) { it.yielding { neighbors.ids.list.size } } }
            val around = alignedOn("around") {
                exchanging(0) { seen -> seen.map { neighboring(it.id).neighbors.ids.list.size }.yielding { all.toMap() } }
            }
            near to around
        }
        repeat(2) { network.round(program) }
        assertEquals(1 to mapOf(2 to 1, 1 to 1), network.round(program)[1])
    }

    @Test
    fun `a field stored in an earlier round is projected to the current neighbours`() {
        val network = network(1, 2, 3, 4).line(1, 2, 3).line(2, 4)
        val program: Aggregate<Int>.() -> Any? = {
            val now = alignedOn("now") { listOf(neighborhood()) }.single()
            alignedOn("then") {
                evolving(now) { then -> now.yielding { project(then, "then@Test.kt:1#0123456789abcdef", true)?.neighbors?.ids?.list } }
            }
        }
        repeat(3) { network.round(program) }
        assertEquals(listOf(1, 3, 4), network.round(program)[2])
        network.remove(3)
        assertEquals(listOf(1, 4), network.round(program)[2])
    }

    @Test
    fun `a device and its fields cannot be used on another thread while the round runs`() {
        val network = network(1, 2).line(1, 2)
        val program: Aggregate<Int>.() -> Any? = {
            val near = neighborhood()
            val uses = listOf<() -> Any?>({ evolve(0) { it } }, { near.map { it.id } })
            uses.map { use -> CompletableFuture.supplyAsync { runCatching(use).exceptionOrNull()?.message }.get() }
        }
        val message = "device 1 or one of its fields is used outside its round or on another thread"
        assertEquals(listOf(message, message), network.round(program)[1])
    }

    @Test
    fun `two primitives at one path clash, and the error names the path`() {
        val network = network(1)
        val error = assertFailsWith<AlignmentClashException> {
            network.round {
                alignedOn("outer") {
                    alignedOn(7) {
                        evolve(0) { it }
                        evolve(0) { it }
                    }
                }
            }
        }
        assertEquals<Path>(FullPath(listOf("outer", 7)), error.path)
        assertNull(error.previous, "evolve must not send anything")
        assertEquals(SharedData<Int, Int>(0), error.current)
        assertTrue("outer > 7" in error.message.orEmpty())
        val second = assertFailsWith<AlignmentClashException> {
            network.round { neighboring(1).also { neighboring(2) } }
        }
        assertEquals(1 to 2, second.previous?.payload to second.current.default)
    }

    @Test
    fun `a loop clashes without a key, and works with one`() {
        val network = network(1, 2).line(1, 2)
        val program: Aggregate<Int>.() -> Any? = {
            (0 until 20).sumOf { key -> alignedOn(key) { neighboring(key).neighbors.values.list.sum() } }
        }
        network.round(program)
        assertEquals(190, network.round(program)[1])
    }

    @Test
    fun `fields do not leave alignedOn, evolve or evolving`() {
        val network = network(1)
        assertFailsWith<IllegalStateException> { network.round { alignedOn(1) { neighboring(1) } } }
        assertFailsWith<IllegalStateException> {
            network.round { evolve<Any>(0) { listOf(neighborhood()).first() } }
        }
        assertFailsWith<IllegalStateException> {
            network.round {
                val field = alignedOn("x") { neighborhood().let { listOf(it) } }.first()
                evolving(0) { it.yielding { field } }
            }
        }
    }

    @Test
    fun `a caught exception restores the stack`() {
        val network = network(1, 2).line(1, 2)
        val program: Aggregate<Int>.() -> Any? = {
            if (localId == 1) runCatching { alignedOn("a") { alignedOn("b") { error("caught") } } }
            neighboring(localId).neighbors.values.list
        }
        network.round(program)
        assertEquals(mapOf<Int, Any?>(1 to listOf(2), 2 to listOf(1)), network.round(program))
    }

    @Test
    fun `a failed round changes neither state nor sent messages`() {
        val network = network(1, 2).line(1, 2)
        fun program(fails: Boolean): Aggregate<Int>.() -> Any? = {
            val count = alignedOn("count") { evolve(0) { it + 1 } }
            val seen = alignedOn("seen") { neighboring(count).neighbors.values.list }
            if (fails && localId == 1) error("broken")
            count to seen
        }
        network.round(program(false))
        assertTrue(network.outcomes(program = program(true)).getValue(1).isFailure)
        assertEquals(mapOf<Int, Any?>(1 to (2 to listOf(2)), 2 to (3 to listOf(1))), network.round(program(false)))
    }

    @Test
    fun `a value that the rule refuses can be neither shared, nor stored, nor a pivot`() {
        val network = Network(AggregateRuntimes { if (it is StringBuilder) "a builder changes" else null }, 1)
        val view = StringBuilder("view")
        val programs = listOf<Aggregate<Int>.() -> Any?>(
            { alignedOn("here") { neighboring(view).local.value } },
            { alignedOn("here") { evolve(view) { it } } },
            { alignedOn("here") { share(view) { it.local.value } } },
            { alignedOn("here") { evolving<Any, Int>(view) { it.yielding { 1 } } } },
        )
        for (program in programs) {
            val error = assertFailsWith<IllegalArgumentException> { network.round(program) }
            assertEquals("a builder changes; it cannot be shared or stored [node 1 at here]", error.message)
        }
        val pivot = assertFailsWith<IllegalArgumentException> {
            network.round { alignedOn(view) { evolve(0) { it } } }
        }
        assertEquals("a builder changes; it cannot be a pivot [node 1 at root]", pivot.message)
    }

    @Test
    fun `the stack can be deep`() {
        fun Aggregate<Int>.nested(depth: Int): Int =
            if (depth == 0) neighboring(localId).neighbors.values.list.sum() else alignedOn(depth) { nested(depth - 1) }
        val network = network(1, 2).line(1, 2)
        network.round { nested(500) }
        assertEquals(mapOf<Int, Any?>(1 to 2, 2 to 1), network.round { nested(500) })
    }
}
