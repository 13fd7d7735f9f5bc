package org.collektive.runtime.routes

import it.unibo.collektive.aggregate.AlignmentClashException
import it.unibo.collektive.path.tokens
import org.junit.jupiter.api.Test
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Compares all routes with [ReferenceRoute]: random programs on random, changing graphs, with failing rounds. */
class RoutesTest {
    @Test
    fun `every route returns, keeps and sends what the reference does`() {
        var rounds = 0
        var clashes = 0
        val values = HashSet<Any?>()
        for (seed in 0 until 120) {
            val random = Random(seed)
            val reference = ReferenceRoute()
            val mailboxes = MailboxRoute(inMemory = true)
            FastRoute(1).use { one ->
                FastRoute(4).use { four ->
                    val others = listOf(one, four, mailboxes, MailboxRoute(inMemory = false))
                    val all = others + reference
                    val graph = Graph()
                    var nextId = 0
                    val programs = RandomPrograms(random).let { source -> List(2) { source.next() } }
                    repeat(25) {
                        graph.now++
                        while (graph.ids.size < 2 || random.nextInt(8) == 0) {
                            graph.add(nextId)
                            all.forEach { it.add(nextId) }
                            nextId++
                        }
                        if (random.nextInt(10) == 0) {
                            val removed = graph.ids.random(random)
                            graph.remove(removed)
                            all.forEach { it.remove(removed) }
                            // Sometimes a new device gets the id of the removed one.
                            if (random.nextBoolean()) {
                                graph.add(removed)
                                all.forEach { it.add(removed) }
                            }
                        }
                        for (from in graph.ids) {
                            for (to in graph.ids) {
                                if (from == to || random.nextInt(4) != 0) continue
                                if (random.nextInt(3) == 0) graph.cut(from, to) else graph.link(from, to)
                            }
                        }
                        graph.now++
                        val due = graph.ids.filter { random.nextInt(5) != 0 }
                        val program = programs[if (random.nextInt(5) == 0) 1 else 0]
                        val expected = reference.round(graph, due, program)
                        for (route in others) {
                            val seen = route.round(graph, due, program)
                            assertEquals(
                                expected.mapValues(::shown),
                                seen.mapValues(::shown),
                                "${route.name}, seed $seed, time ${graph.now}",
                            )
                        }
                        for (id in graph.ids) {
                            assertEquals(
                                reference.records.getValue(id).kept,
                                mailboxes.state(id).mapKeys { it.key.tokens },
                                "state of $id, seed $seed",
                            )
                        }
                        graph.sent(expected.filterValues { it.isSuccess }.keys)
                        rounds += due.size
                        clashes += expected.values.count { it.exceptionOrNull() is AlignmentClashException }
                        values.addAll(expected.values.map { it.getOrNull() })
                    }
                }
            }
        }
        assertTrue(
            rounds > 5000 && clashes in 1..rounds / 3 && values.size > 200,
            "$rounds rounds, $clashes clashes, ${values.size} results",
        )
    }

    private fun shown(entry: Map.Entry<Int, Result<Any?>>): Any? =
        entry.value.fold({ it }, { "${it::class.simpleName}: ${if (it is AlignmentClashException) it.path.tokens else it.message}" })
}
