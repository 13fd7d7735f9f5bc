package org.collektive.conformance.golden

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.exchange
import it.unibo.collektive.aggregate.api.exchanging
import it.unibo.collektive.aggregate.api.mapNeighborhood
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.aggregate.api.sharing
import it.unibo.collektive.aggregate.toMap
import it.unibo.collektive.aggregate.values
import it.unibo.collektive.stdlib.accumulation.convergeCast
import it.unibo.collektive.stdlib.accumulation.convergeMean
import it.unibo.collektive.stdlib.accumulation.convergeSum
import it.unibo.collektive.stdlib.accumulation.countDevices
import it.unibo.collektive.stdlib.accumulation.findParent
import it.unibo.collektive.stdlib.accumulation.findParents
import it.unibo.collektive.stdlib.collapse.all
import it.unibo.collektive.stdlib.collapse.any
import it.unibo.collektive.stdlib.collapse.countMatching
import it.unibo.collektive.stdlib.collapse.fold
import it.unibo.collektive.stdlib.collapse.idOfMax
import it.unibo.collektive.stdlib.collapse.idOfMin
import it.unibo.collektive.stdlib.collapse.idOfMinBy
import it.unibo.collektive.stdlib.collapse.max
import it.unibo.collektive.stdlib.collapse.maxBy
import it.unibo.collektive.stdlib.collapse.min
import it.unibo.collektive.stdlib.collapse.product
import it.unibo.collektive.stdlib.collapse.sum
import it.unibo.collektive.stdlib.collapse.valueOfMaxBy
import it.unibo.collektive.stdlib.consensus.boundedElection
import it.unibo.collektive.stdlib.consensus.globalElection
import it.unibo.collektive.stdlib.doubles.FieldedDoubles.times
import it.unibo.collektive.stdlib.ints.FieldedInts.plus
import it.unibo.collektive.stdlib.ints.FieldedInts.toDouble
import it.unibo.collektive.stdlib.processes.timeReplicated
import it.unibo.collektive.stdlib.spreading.bellmanFordGradientCast
import it.unibo.collektive.stdlib.spreading.distanceTo
import it.unibo.collektive.stdlib.spreading.everHappened
import it.unibo.collektive.stdlib.spreading.gossip
import it.unibo.collektive.stdlib.spreading.gossipMax
import it.unibo.collektive.stdlib.spreading.gossipMaxBy
import it.unibo.collektive.stdlib.spreading.gossipMin
import it.unibo.collektive.stdlib.spreading.gossipMinBy
import it.unibo.collektive.stdlib.spreading.gradientCast
import it.unibo.collektive.stdlib.spreading.hopDistanceTo
import it.unibo.collektive.stdlib.spreading.hopGradientCast
import it.unibo.collektive.stdlib.spreading.intGradientCast
import it.unibo.collektive.stdlib.spreading.isHappeningAnywhere
import it.unibo.collektive.stdlib.spreading.multiGradientCast
import it.unibo.collektive.stdlib.spreading.multiIntGradientCast
import it.unibo.collektive.stdlib.spreading.nonStabilizingGossip
import it.unibo.collektive.stdlib.time.localDeltaTime
import it.unibo.collektive.stdlib.time.sharedClock
import it.unibo.collektive.stdlib.time.sharedTimeLeftTo
import it.unibo.collektive.stdlib.util.coerceIn
import it.unibo.collektive.stdlib.util.euclideanDistance2D
import it.unibo.collektive.stdlib.util.hops
import it.unibo.collektive.stdlib.util.replaceMatchingValues
import kotlin.time.Duration.Companion.milliseconds
import kotlin.time.Duration.Companion.seconds
import kotlin.time.Instant

fun <T> Field<Int, T>.str(): String = neighbors.toMap().toSortedMap().toString() + "/" + local.value
fun <T> Field<Int, T>.strAll(): String = all.toMap().toSortedMap().toString()

fun Aggregate<Int>.helper(x: Int): Int = share(x) { f -> minOf(x, f.neighbors.values.min(100) + 1) }
fun Aggregate<Int>.twice(x: Int): Int = helper(x) + helper(x + 1)
fun Aggregate<Int>.deep(n: Int, x: Int): Int = if (n == 0) helper(x) else deep(n - 1, x) + 1
fun plain(x: Int) = x * 2
inline fun Aggregate<Int>.inl(b: () -> Int): Int = b() + helper(9)
fun Aggregate<Int>.lam(b: () -> Int): Int = b() + 1
fun Aggregate<Int>.lamA(b: Aggregate<Int>.(Int) -> Int): Int = b(3) + this.b(4)
fun Aggregate<Int>.euclid(s: Senses): Field<Int, Double> = euclideanDistance2D(s.x to s.y)
interface Prog {
    fun run(a: Aggregate<Int>, x: Int): Int
}
class P1 : Prog {
    override fun run(a: Aggregate<Int>, x: Int): Int = a.helper(x)
}
class P2 : Prog {
    override fun run(a: Aggregate<Int>, x: Int): Int = a.helper(x + 1) + 5
}
object Agent {
    fun Aggregate<Int>.act(x: Int): Int = helper(x) + neighboring(x).neighbors.size
}

fun Aggregate<Int>.neigh(s: Senses): Any? = neighboring(s.number).str()
fun Aggregate<Int>.shareMax(s: Senses): Any? = share(s.number) { f -> maxOf(f.all.values.max(), s.number) }
fun Aggregate<Int>.shareSum(s: Senses): Any? = share(0) { f -> (f.neighbors.values.sum() + s.number) % 1000 }
fun Aggregate<Int>.exch(s: Senses): Any? = exchange(0) { f -> f.map { (id, v) -> (v + id * 3 + s.number) % 97 } }.str()
fun Aggregate<Int>.exchY(s: Senses): Any? = exchanging(s.number) { f ->
    f.map { (id, v) -> (v * 2 + id) % 31 }.yielding {
        f.str() +
            this.str()
    }
}
fun Aggregate<Int>.shar(s: Senses): Any? =
    sharing(1) { f -> ((f.neighbors.values.sum() + f.local.value) % 50 + 1).yielding { "$this:${f.str()}" } }
fun Aggregate<Int>.evo(s: Senses): Any? = evolve(0) { it + s.number } to evolving(1) { x -> (x * 2 % 1009).yielding { x } }
fun Aggregate<Int>.branchIf(s: Senses): Any? = if (s.flag) {
    helper(s.number)
} else {
    neighboring(s.number).neighbors.size * 1000 +
        helper(s.number)
}
fun Aggregate<Int>.branchIfState(s: Senses): Any? = if (s.flag) evolve(0) { it + 1 } else evolve(100) { it + 1 }
fun Aggregate<Int>.branchWhen(s: Senses): Any? {
    val k =
        share(s.number) { f -> f.all.values.max() } + s.number
    return when (k % 3) {
        0 -> helper(s.number)
        1 -> helper(s.number)
        else -> twice(s.number)
    }
}
fun Aggregate<Int>.branchShared(s: Senses): Any? {
    val k = neighboring(s.flag).neighbors.values.list.count { it }
    return if (k > 1) {
        share(0) { f -> f.neighbors.size + f.neighbors.values.max(0) % 7 }
    } else {
        -1
    }
}
fun Aggregate<Int>.nested(s: Senses): Any? =
    listOf(plain(plain(helper(plain(s.number)))), twice(s.number), deep(s.number % 4, s.number), helper(helper(s.number)))
fun Aggregate<Int>.projected(s: Senses): Any? {
    val f = neighboring(s.number)
    return if (s.flag) {
        f.str()
    } else {
        "e" +
            f.map { it.value + 1 }.str()
    }
}
fun Aggregate<Int>.projNested(s: Senses): Any? {
    val f = neighboring(s.number)
    val g = neighboring(s.id)
    return if (s.flag) {
        if (s.number %
            2 ==
            0
        ) {
            f.alignedMapValues(g) { a, b -> a * 100 + b }.str()
        } else {
            g.str()
        }
    } else {
        (f + g).str()
    }
}
fun Aggregate<Int>.projAligned(s: Senses): Any? {
    val f = neighboring(s.number)
    return alignedOn(s.number % 2) {
        f.alignedMapValues(neighboring(s.id)) { a, b ->
            a -
                b
        }.str()
    }
}
fun Aggregate<Int>.projShare(s: Senses): Any? = share(0) { f -> if (s.flag) f.neighbors.values.sum() % 100 + 1 else f.neighbors.size }
fun Aggregate<Int>.pivot(s: Senses): Any? =
    alignedOn(s.number % 3) { helper(s.number) } to alignedOn("k${s.number % 2}") { share(0) { f -> f.neighbors.size } }
fun Aggregate<Int>.loops(s: Senses): Any? {
    var t = ""
    for (i in 0..(s.number % 3)) {
        t +=
            alignedOn(i) { helper(s.number + i) }.toString() + ";"
    }
    return t +
        listOf(1, 2).map { alignedOn(it) { neighboring(s.number + it).str() } }
}
fun Aggregate<Int>.lambdas(s: Senses): Any? = listOf(
    inl {
        helper(s.number)
    },
    lam { helper(s.number) },
    lamA { helper(it + s.number) },
    run { helper(s.number) },
    s.let { helper(it.number) },
)
fun Aggregate<Int>.virt(s: Senses): Any? {
    val p: Prog = if (s.flag) P1() else P2()
    return p.run(this, s.number)
}
fun Aggregate<Int>.member(s: Senses): Any? = with(Agent) { act(s.number) }
fun Aggregate<Int>.elvis(s: Senses): Any? = (if (s.flag) s.number else null) ?: helper(s.number)
fun Aggregate<Int>.andand(s: Senses): Any? = (s.flag && helper(s.number) > 3) to (s.isSource || neighboring(s.number).neighbors.size > 2)
fun Aggregate<Int>.nestPrim(s: Senses): Any? = share(s.number) { f ->
    val g = neighboring(f.local.value)
    val h = g.alignedMapValues(f) { a, b ->
        a +
            b
    }
    (h.neighbors.values.sum() + exchange(1) { e -> e.mapValues { (it + 1) % 5 } }.local.value) % 61
}
fun Aggregate<Int>.lazyDel(s: Senses): Any? {
    val v by lazy { helper(s.number) }
    return if (s.flag) v else -1
}
fun Aggregate<Int>.destruct(s: Senses): Any? {
    val (a, b) = helper(s.number) to neighboring(s.number).neighbors.size
    return a + b
}
fun Aggregate<Int>.strTemplate(s: Senses): Any? = "${helper(s.number)}-${helper(s.number)}-${neighboring(s.number).str()}"
fun Aggregate<Int>.mapNb(s: Senses): Any? = mapNeighborhood { if (it == localId) -1 else it * 2 }.str()
fun Aggregate<Int>.fieldOps(s: Senses): Any? {
    val f = neighboring(s.number)
    return listOf(
        f.neighbors.idOfMin(), f.neighbors.idOfMax(),
        f.all.idOfMinBy {
            it.value
        },
        f.neighbors.values.min(99), f.all.values.max(),
        f.neighbors.countMatching {
            it.value >
                5
        },
        f.all.fold(0) { a, e ->
            a + e.id
        },
        f.neighbors.values.any {
            it > 8
        },
        f.replaceMatchingValues(-1) {
            it > 5
        }.str(),
        f.coerceIn(2, 6).str(), f.toDouble().times(0.5).str(),
        f.neighbors.maxBy {
            it.value
        }?.id,
        f.all.valueOfMaxBy { -it.value }, f[localId], f.all.values.sum(), f.neighbors.values.product(),
    )
}
fun Aggregate<Int>.dist(s: Senses): Any? = distanceTo(s.isSource)
fun Aggregate<Int>.distE(s: Senses): Any? = distanceTo(s.isSource, euclid(s))
fun Aggregate<Int>.distEMax(s: Senses): Any? = distanceTo(s.isSource, euclid(s), maxDiameter = 4)
fun Aggregate<Int>.hopD(s: Senses): Any? = hopDistanceTo(s.isSource)
fun Aggregate<Int>.hopDMax(s: Senses): Any? = hopDistanceTo(s.isSource, 3)
fun Aggregate<Int>.gc(s: Senses): Any? = gradientCast(s.isSource, s.number, euclid(s))
fun Aggregate<Int>.gcAcc(s: Senses): Any? = gradientCast(s.isSource, s.number.toDouble(), euclid(s), accumulateData = { a, b, d ->
    d + b +
        a / 16
})
fun Aggregate<Int>.igc(s: Senses): Any? = intGradientCast(s.isSource, s.number, metric = hops(), accumulateData = { _, _, d -> d + 1 })
fun Aggregate<Int>.hgc(s: Senses): Any? = hopGradientCast(s.isSource, s.number)
fun Aggregate<Int>.bf(s: Senses): Any? = bellmanFordGradientCast(s.isSource, s.number, metric = euclid(s))
fun Aggregate<Int>.mgc(s: Senses): Any? = multiGradientCast(listOf(0, 3, 5), s.number, euclid(s)).toSortedMap()
fun Aggregate<Int>.migc(s: Senses): Any? = multiIntGradientCast(if (s.tick < 12) listOf(0, 3, 5) else listOf(0, 7), s.number).toSortedMap()
fun Aggregate<Int>.elect(s: Senses): Any? = boundedElection(s.id * 7 % 11, 3)
fun Aggregate<Int>.electE(s: Senses): Any? = boundedElection(s.id * 7 % 11, 2.5, euclid(s))
fun Aggregate<Int>.electId(s: Senses): Any? = boundedElection(2)
fun Aggregate<Int>.electIdE(s: Senses): Any? = boundedElection(2.5, euclid(s))
fun Aggregate<Int>.electG(s: Senses): Any? = globalElection() to globalElection(s.id * 7 % 11)
fun Aggregate<Int>.ccSum(s: Senses): Any? {
    val d = hopDistanceTo(s.isSource)
    return convergeSum(1, d) to
        convergeCast(s.number, d) { a, b -> maxOf(a, b) }
}
fun Aggregate<Int>.ccList(s: Senses): Any? {
    val d = distanceTo(s.isSource, euclid(s))
    return convergeCast(listOf(s.id), d) { a, b ->
        (
            a +
                b
            ).distinct().sorted()
    }
}
fun Aggregate<Int>.ccSink(s: Senses): Any? =
    listOf(convergeSum(s.number, s.isSource), convergeMean(s.number.toDouble(), s.isSource), convergeSum(0.5, s.isSource))
fun Aggregate<Int>.count(s: Senses): Any? = countDevices(s.isSource) to countDevices(hopDistanceTo(s.isSource))
fun Aggregate<Int>.parent(s: Senses): Any? =
    findParent(neighboring(hopDistanceTo(s.isSource))) to findParents(neighboring(hopDistanceTo(s.isSource))).sorted()
fun Aggregate<Int>.gos(s: Senses): Any? = gossip(s.number) { a, b -> maxOf(a, b) }
fun Aggregate<Int>.gosMM(s: Senses): Any? = listOf(
    gossipMax(s.number),
    gossipMin(s.number),
    gossipMaxBy(s.number) { -it },
    gossipMinBy(s.number) {
        it %
            4
    },
)
fun Aggregate<Int>.gosMax2(s: Senses): Any? = gossipMax(s.number, 2)
fun Aggregate<Int>.happen(s: Senses): Any? =
    listOf(isHappeningAnywhere { s.flag && s.number > 8 }, everHappened { s.number == 9 }, nonStabilizingGossip(s.number, ::maxOf))
fun Aggregate<Int>.clock(s: Senses): Any? = sharedClock(Instant.fromEpochMilliseconds(s.milliseconds))
fun Aggregate<Int>.ldt(s: Senses): Any? = localDeltaTime(Instant.fromEpochMilliseconds(s.milliseconds))
fun Aggregate<Int>.timeLeft(s: Senses): Any? = sharedTimeLeftTo(Instant.fromEpochMilliseconds(s.milliseconds), 3.seconds)
fun Aggregate<Int>.repl(s: Senses): Any? =
    timeReplicated(Instant.fromEpochMilliseconds(s.milliseconds), 3, 2.seconds) { nonStabilizingGossip(s.number, ::maxOf) }
fun Aggregate<Int>.scr(s: Senses): Any? {
    val m = euclid(s)
    val l = boundedElection(s.id, 4.0, m)
    val d = distanceTo(l == localId, m)
    val c = convergeCast(1, d) { a, b ->
        a +
            b
    }
    return "$l $d $c " + gradientCast(l == localId, c, m)
}
fun Aggregate<Int>.channel(s: Senses): Any? {
    val a = distanceTo(s.isSource, euclid(s))
    val b = distanceTo(s.id == 7, euclid(s))
    val w = gradientCast(s.isSource, b, euclid(s))
    return a +
        b <=
        w + 0.5
}
fun Aggregate<Int>.branchDist(s: Senses): Any? = if (s.flag) distanceTo(s.isSource, euclid(s)) else hopDistanceTo(s.isSource).toDouble()
fun Aggregate<Int>.gradInLoop(s: Senses): Any? = (0..2).map { alignedOn(it) { hopDistanceTo(s.id % 3 == it) } }
fun Aggregate<Int>.breakLoop(s: Senses): Any? {
    var r = 0
    for (i in 0..4) {
        alignedOn(i) { r += helper(s.number) }
        if (i >= s.number % 3) {
            break
        }
    }
    return r to helper(s.number)
}

/** The golden programs by name. */
val goldenPrograms: Map<String, GoldenProgram> = mapOf(
    "neigh" to Aggregate<Int>::neigh,
    "shareMax" to Aggregate<Int>::shareMax,
    "shareSum" to Aggregate<Int>::shareSum,
    "exch" to Aggregate<Int>::exch,
    "exchY" to Aggregate<Int>::exchY,
    "shar" to Aggregate<Int>::shar,
    "evo" to Aggregate<Int>::evo,
    "branchIf" to Aggregate<Int>::branchIf,
    "branchIfState" to Aggregate<Int>::branchIfState,
    "branchWhen" to Aggregate<Int>::branchWhen,
    "branchShared" to Aggregate<Int>::branchShared,
    "nested" to Aggregate<Int>::nested,
    "projected" to Aggregate<Int>::projected,
    "projNested" to Aggregate<Int>::projNested,
    "projAligned" to Aggregate<Int>::projAligned,
    "projShare" to Aggregate<Int>::projShare,
    "pivot" to Aggregate<Int>::pivot,
    "loops" to Aggregate<Int>::loops,
    "lambdas" to Aggregate<Int>::lambdas,
    "virt" to Aggregate<Int>::virt,
    "member" to Aggregate<Int>::member,
    "elvis" to Aggregate<Int>::elvis,
    "andand" to Aggregate<Int>::andand,
    "nestPrim" to Aggregate<Int>::nestPrim,
    "lazyDel" to Aggregate<Int>::lazyDel,
    "destruct" to Aggregate<Int>::destruct,
    "strTemplate" to Aggregate<Int>::strTemplate,
    "mapNb" to Aggregate<Int>::mapNb,
    "fieldOps" to Aggregate<Int>::fieldOps,
    "dist" to Aggregate<Int>::dist,
    "distE" to Aggregate<Int>::distE,
    "distEMax" to Aggregate<Int>::distEMax,
    "hopD" to Aggregate<Int>::hopD,
    "hopDMax" to Aggregate<Int>::hopDMax,
    "gc" to Aggregate<Int>::gc,
    "gcAcc" to Aggregate<Int>::gcAcc,
    "igc" to Aggregate<Int>::igc,
    "hgc" to Aggregate<Int>::hgc,
    "bf" to Aggregate<Int>::bf,
    "mgc" to Aggregate<Int>::mgc,
    "migc" to Aggregate<Int>::migc,
    "elect" to Aggregate<Int>::elect,
    "electE" to Aggregate<Int>::electE,
    "electId" to Aggregate<Int>::electId,
    "electIdE" to Aggregate<Int>::electIdE,
    "electG" to Aggregate<Int>::electG,
    "ccSum" to Aggregate<Int>::ccSum,
    "ccList" to Aggregate<Int>::ccList,
    "ccSink" to Aggregate<Int>::ccSink,
    "count" to Aggregate<Int>::count,
    "parent" to Aggregate<Int>::parent,
    "gos" to Aggregate<Int>::gos,
    "gosMM" to Aggregate<Int>::gosMM,
    "gosMax2" to Aggregate<Int>::gosMax2,
    "happen" to Aggregate<Int>::happen,
    "clock" to Aggregate<Int>::clock,
    "ldt" to Aggregate<Int>::ldt,
    "timeLeft" to Aggregate<Int>::timeLeft,
    "repl" to Aggregate<Int>::repl,
    "scr" to Aggregate<Int>::scr,
    "channel" to Aggregate<Int>::channel,
    "branchDist" to Aggregate<Int>::branchDist,
    "gradInLoop" to Aggregate<Int>::gradInLoop,
    "breakLoop" to Aggregate<Int>::breakLoop,
)
