package org.collektive.conformance.golden

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.exchanging
import it.unibo.collektive.aggregate.api.mapNeighborhood
import it.unibo.collektive.aggregate.ids
import it.unibo.collektive.aggregate.values
import it.unibo.collektive.stdlib.collapse.sum
import org.collektive.mailbox.MailboxRuntimes
import org.collektive.runtime.AggregateRuntimes
import org.collektive.spi.DeviceRuntimes
import org.collektive.testkit.Network
import kotlin.math.hypot
import kotlin.random.Random
import kotlin.test.Test

fun Aggregate<Int>.exchNext(source: Boolean): Int = exchanging(if (source) 1 else 0) { f ->
    val next = f.neighbors.ids.list.minOrNull()
    mapNeighborhood { id -> if (id == next) f.all.values.sum() else 0 }.yielding { f.all.values.sum() }
}

@CollektiveIgnore("drives")
class ScratchTest {
    private fun run(runtimes: DeviceRuntimes, seed: Int): List<String> {
        val out = ArrayList<String>()
        val r = Random(seed)
        val network = Network(runtimes)
        val places = sortedMapOf<Int, Pair<Double, Double>>()
        repeat(30) {
            places[it] = r.nextDouble(6.0) to r.nextDouble(6.0)
            network.add(it)
        }
        for (t in 1..30) {
            for (k in places.keys.toList()) {
                if (r.nextInt(10) ==
                    0
                ) {
                    val (x, y) = places.getValue(k)
                    places[k] = x + r.nextDouble(-.6, .6) to y + r.nextDouble(-.6, .6)
                }
            }
            for ((a, from) in places) {
                for ((b, to) in places.tailMap(a + 1)) {
                    if (hypot(from.first - to.first, from.second - to.second) <= 1.5) network.link(a, b) else network.unlink(a, b)
                }
            }
            val due = places.keys.filter { r.nextInt(10) < 7 }
            for ((id, a) in network.round(due) { exchNext(localId == 0) }) out += "$t $id $a"
        }
        return out
    }

    @Test
    fun x() {
        for (seed in 1..20) {
            val a = run(AggregateRuntimes(), seed)
            val b = run(MailboxRuntimes(), seed)
            println(
                "seed $seed: ${a.indices.count {
                    a[it] != b[it]
                }} differ; first ${a.indices.firstOrNull { a[it] != b[it] }?.let { a[it] + " / " + b[it] }}",
            )
        }
    }
}
