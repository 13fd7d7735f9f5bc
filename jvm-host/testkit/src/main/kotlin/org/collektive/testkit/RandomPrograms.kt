package org.collektive.testkit

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.exchanging
import it.unibo.collektive.aggregate.api.mapNeighborhood
import it.unibo.collektive.aggregate.api.neighborhood
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.aggregate.api.sharing
import it.unibo.collektive.aggregate.values
import org.collektive.alignment.project
import kotlin.random.Random

/** A part of a program; returns a number or `null`. */
public typealias Piece = Aggregate<Int>.() -> Int?

/** Random programs of all primitives: nested in each other, in branches, in recursion and aligned on data. */
public class RandomPrograms(private val random: Random) {
    private var places = 0

    /** Returns the next program. */
    public fun next(): Piece = piece(4)

    private fun piece(depth: Int): Piece {
        if (depth == 0) return leaf()
        val a = piece(depth - 1)
        val b = piece(depth - 1)
        val k = random.nextInt(1, 6)
        return when (random.nextInt(14)) {
            0 -> at { evolve<Int?>(k) { old -> if (old == null) k else mix(old, alignedOn("inside") { a() }) } }

            1 -> at { evolving<Int?, Int?>(null) { old -> mix(old, k).yielding { mix(this, alignedOn("inside") { b() }) } } }

            2 -> at { share<Int, Int?>(a()) { seen -> seen.neighbors.values.list.fold(k as Int?, ::mix) } }

            3 -> at { sharing<Int, Int?, Int?>(k) { seen -> mix(seen.local.value, k).yielding { seen.all.values.list.fold(null, ::mix) } } }

            4 -> {
                val field: Piece = {
                    exchanging<Int, Int?, Int?>(k) { seen ->
                        seen.map { mix(it.id, it.value) }.yielding { seen.neighbors.values.list.fold(null, ::mix) }
                    }
                }
                at { mix(field(), alignedOn("after") { a() }) }
            }

            5 -> at { neighboring(a()).all.list.fold(null as Int?) { sum, entry -> mix(mix(sum, entry.id), entry.value) } }

            6 -> at { if ((alignedOn("condition") { a() } ?: 0) % 2 == 0) alignedOn(true) { b() } else alignedOn(false) { leaf(this) } }

            7 -> at { alignedOn(alignedOn("pivot") { a() }) { b() } }

            8 -> at { mapNeighborhood { id -> mix(id, neighboring(id).neighbors.values.list.size) }.all.values.list.fold(null, ::mix) }

            9 -> at { recursion(localId % 3 + k % 3, a) }

            10 -> at { runCatching { alignedOn("risky") { if ((localId + k) % 3 == 0) error("caught") else a() } }.getOrDefault(-k) }

            11 -> at {
                val field = neighboring<Int, Int?>(k)
                val branch = (localId + (alignedOn("condition") { a() } ?: 1)) % 2
                alignedOn(branch) {
                    val entries = project(field, "field@Test.kt:1#0123456789abcdef", true)?.all?.list
                    entries?.fold(null as Int?) { s, e -> mix(mix(s, e.id), e.value) }
                }
            }

            12 -> at { mix(neighborhood().neighbors.list.size, alignedOn("b") { b() }) }

            else -> at {
                val first = evolve(k) { it + 1 }
                // A second primitive at the same path, on some devices.
                if (k == 1 && localId % 3 == 0) mix(neighboring(first).local.value, first) else mix(first, alignedOn("b") { b() })
            }
        }
    }

    private fun leaf(): Piece = when (random.nextInt(4)) {
        0 -> {
            { localId }
        }

        1 -> {
            { null }
        }

        2 -> at { evolve(0) { it + 1 } }

        else -> at { neighboring(localId).neighbors.values.list.sum() }
    }

    private fun leaf(aggregate: Aggregate<Int>): Int? = aggregate.localId

    private fun at(piece: Piece): Piece {
        val place = "place ${places++}"
        return { alignedOn(place) { piece() } }
    }

    private fun Aggregate<Int>.recursion(depth: Int, piece: Piece): Int? =
        if (depth == 0) piece() else mix(evolve(depth) { it + 1 }, alignedOn(depth) { recursion(depth - 1, piece) })

    private companion object {
        fun mix(a: Int?, b: Int?): Int? = if (a == null && b == null) null else ((a ?: 7) * 31 + (b ?: 13)) % 1009
    }
}
