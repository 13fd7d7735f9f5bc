package it.unibo.collektive.stdlib.spreading

import it.unibo.collektive.aggregate.api.mapNeighborhood
import it.unibo.collektive.stdlib.Swarm
import it.unibo.collektive.stdlib.hopsFrom
import it.unibo.collektive.stdlib.perturbed
import it.unibo.collektive.stdlib.shortestPaths
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertNull
import kotlin.test.assertTrue

class GradientCastTest {
    @Test
    fun `distances are shortest paths within the bound after any perturbation`() = perturbed { swarm, atOnce, random ->
        val sources = swarm.ids.filter { random.nextInt(5) == 0 }.toSet()
        val seen = swarm.rounds(2 * swarm.size, atOnce) { distanceTo(localId in sources, with(swarm) { lengths() }) }
        val paths = swarm.shortestPaths(sources)
        assertEquals(swarm.ids.associateWith { paths[it]?.first ?: Double.POSITIVE_INFINITY }, seen)
    }

    @Test
    fun `data comes from the nearest source and accumulates hop by hop`() = perturbed { swarm, atOnce, random ->
        val sources = swarm.ids.filter { random.nextInt(4) == 0 }.toSet()
        val seen = swarm.rounds(2 * swarm.size, atOnce) {
            gradientCast(
                localId in sources,
                localId to 0.0,
                with(swarm) { lengths() },
                accumulateData = { fromSource, toNeighbor, (source, _) -> source to fromSource + toNeighbor },
            )
        }
        val paths = swarm.shortestPaths(sources)
        assertEquals(swarm.ids.associateWith { id -> paths[id].let { if (it == null) id to 0.0 else it.second to it.first } }, seen)
    }

    @Test
    fun `data whose equals ignores a change is updated`() {
        val swarm = Swarm(3).line(1.0, 1.0)
        for (note in listOf("old", "new")) {
            val seen = swarm.rounds(4) {
                val metric = with(swarm) { lengths() }
                val sent = alignedOn("sent") { gradientCast(localId == 0, Labelled(1, note), metric) }
                val accumulated = alignedOn("accumulated") {
                    gradientCast(localId == 0, Labelled(1, note), metric, accumulateData = { _, _, _ -> Labelled(1, note) })
                }
                sent.note to accumulated.note
            }
            assertEquals(List(3) { note to note }, seen.values.toList())
        }
    }

    @Test
    fun `hops are counted up to one more than maxDiameter, and are 0 elsewhere`() = perturbed { swarm, atOnce, random ->
        val sources = swarm.ids.filter { random.nextInt(6) == 0 }.toSet()
        val limit = random.nextInt(1, 5)
        val seen = swarm.rounds(2 * limit + 3, atOnce) { hopDistanceTo(localId in sources, limit) }
        val hops = swarm.hopsFrom(sources)
        assertEquals(swarm.ids.associateWith { hops[it]?.takeIf { hop -> hop <= limit + 1 } ?: 0 }, seen)
    }

    @Test
    fun `each of several sources has its own gradient`() = perturbed(0 until 4) { swarm, atOnce, random ->
        val sources = swarm.ids.filter { random.nextInt(4) == 0 }
        val seen = swarm.rounds(2 * swarm.size, atOnce) {
            multiGradientCast(
                sources,
                if (localId in sources) 0.0 else -1.0,
                with(swarm) { lengths() },
                accumulateData = { fromSource, toNeighbor, _ -> fromSource + toNeighbor },
            )
        }
        val expected = swarm.ids.associateWith { id ->
            sources.associateWith { source ->
                swarm.shortestPaths(listOf(source))[id]?.first ?: if (id in sources) 0.0 else -1.0
            }
        }
        assertEquals(expected, seen)
    }

    @Test
    fun `a source that does not list itself still receives from the others`() {
        val swarm = Swarm(3).line(1.0, 1.0)
        val seen = swarm.rounds(4) { multiIntGradientCast(if (localId == 1) listOf(0) else listOf(0, 2), localId) }
        assertEquals(
            mapOf(0 to mapOf(0 to 0, 2 to 0), 1 to mapOf(0 to 0), 2 to mapOf(0 to 0, 2 to 2)),
            seen,
            "device 1 must not forward data of device 2",
        )
    }

    @Test
    fun `values do not count up when a source is removed, even with short links`() {
        val swarm = Swarm(6).line(100.0, 100.0, 0.001, 0.001, 0.001)
        val program: it.unibo.collektive.aggregate.api.Aggregate<Int>.() -> Double = {
            distanceTo(localId == 0, with(swarm) { lengths() })
        }
        assertEquals(200.003, swarm.rounds(12, program = program).getValue(5), 1e-9)
        swarm.unlink(1, 2)
        val after = swarm.rounds(6, program = program)
        assertEquals(List(4) { Double.POSITIVE_INFINITY }, listOf(2, 3, 4, 5).map(after::getValue))
    }

    @Test
    fun `null is valid data`() {
        val swarm = Swarm(2).line(1.0)
        val seen = swarm.rounds(3) { hopGradientCast(localId == 0, if (localId == 0) null else "none") }
        assertNull(seen.getValue(1))
    }

    @Test
    fun `the metric is coerced to bottom and top`() {
        val swarm = Swarm(3).line(-5.0, 50.0)
        val seen = swarm.rounds(5) {
            distanceTo(localId == 0, 1.0, 10.0, with(swarm) { lengths() }) { a, b -> a + b }
        }
        assertEquals(mapOf(0 to 1.0, 1 to 2.0, 2 to 12.0), seen)
    }

    @Test
    fun `an offer that passed a neighbour without an offer is refused, however near it is`() {
        val swarm = Swarm(3).line(0.0, 0.0).apply { link(0, 2, 0.0) }
        fun round(ids: Collection<Int>, source: Int?) =
            swarm.round(ids) { gradientCast(localId == source, localId, with(swarm) { lengths() }) }
        repeat(3) { round(swarm.ids, source = 0) }
        round(listOf(0), source = null)
        assertEquals(2, round(listOf(2), source = null).getValue(2), "device 1 still offers the data of device 0")
    }

    @Test
    fun `an offer is refused where one over fewer hops has them in another order, also at the same distance`() {
        val swarm = Swarm(4).apply { for ((a, b) in listOf(3 to 2, 2 to 1, 1 to 0, 3 to 0)) link(a, b, 0.0) }
        fun round(id: Int, source: Int) =
            swarm.round(listOf(id)) { gradientCast(localId == source, localId, with(swarm) { lengths() }) }.getValue(id)
        for (id in listOf(3, 2, 1)) round(id, source = 3)
        for (id in listOf(2, 3)) round(id, source = 2)
        assertEquals(2, round(0, source = 2), "device 1 offers the data of 3 through 3 and 2, and device 3 the data of 2 through 2")
    }

    @Test
    fun `a sum that is less than one of its parts is an error`() {
        for (sum in listOf<(Int, Int) -> Int>({ a, b -> a - b }, { a, b -> a + b + Int.MAX_VALUE })) {
            val swarm = Swarm(2).line(1.0)
            val error = assertFailsWith<IllegalStateException> {
                swarm.rounds(2) { intGradientCast(localId == 0, 0, mapNeighborhood { 1 }, accumulateDistance = sum) }
            }
            assertTrue("triangle inequality" in error.message.orEmpty(), error.message)
        }
    }

    @Test
    fun `a metric from inside a narrower branch is refused`() {
        val swarm = Swarm(2).line(1.0)
        val error = assertFailsWith<IllegalStateException> {
            swarm.rounds(3) {
                val narrow = alignedOn(localId) { listOf(with(swarm) { lengths() }) }.first()
                distanceTo(localId == 0, narrow)
            }
        }
        assertTrue("has no distance for the aligned neighbour" in error.message.orEmpty(), error.message)
    }

    @Test
    fun `settled networks send the same objects again`() {
        val swarm = Swarm(4).line(1.0, 1.0, 1.0)
        class Box
        val boxes = List(4) { Box() }
        repeat(8) { swarm.round { hopGradientCast(localId == 0, boxes[localId]) } }
        val seen = swarm.round { hopGradientCast(localId == 0, boxes[localId]) }
        assertTrue(seen.values.all { it === boxes[0] })
    }

    @Test
    fun `a settled network reacts to changes even if all offers stay equal`() = perturbed { swarm, atOnce, random ->
        val source = swarm.ids.random(random)
        val lengths = swarm.shortestPaths(listOf(source)).mapValues { (_, path) -> path.first }
        for ((stretch, unit) in listOf(1.0 to 1.0, 2.0 to 1.0, 2.0 to 4.0)) {
            val seen = swarm.rounds(2 * swarm.size, atOnce) {
                gradientCast(
                    localId == source,
                    0.0,
                    with(swarm) { lengths() },
                    accumulateData = { fromSource, toNeighbor, _ -> unit * (fromSource / stretch + toNeighbor) },
                    accumulateDistance = { fromSource, toNeighbor -> fromSource + stretch * toNeighbor },
                )
            }
            assertEquals(swarm.ids.associateWith { unit * (lengths[it] ?: 0.0) }, seen, "links stretched by $stretch, in units of $unit")
        }
    }

    @Test
    fun `a settled network reacts to another maxDiameter`() {
        val swarm = Swarm(5).line(1.0, 1.0, 1.0, 1.0)
        for (limit in listOf(Int.MAX_VALUE, 1, 2)) {
            val seen = swarm.rounds(10) { hopGradientCast(localId == 0, localId == 0, limit) }
            assertEquals(swarm.ids.associateWith { it == 0 || it - 1 <= limit }, seen)
        }
    }

    @Test
    fun `a settled network reacts to a greater limit of distances`() {
        val swarm = Swarm(4).line(1.0, 1.0, 1.0)
        for (top in listOf(1.5, 10.0)) {
            val seen = swarm.rounds(8) { distanceTo(localId == 0, 0.0, top, with(swarm) { lengths() }, accumulateDistance = Double::plus) }
            assertEquals(mapOf(0 to 0.0, 1 to 1.0, 2 to 2.0, 3 to minOf(2.0, top) + 1), seen)
        }
    }
}
