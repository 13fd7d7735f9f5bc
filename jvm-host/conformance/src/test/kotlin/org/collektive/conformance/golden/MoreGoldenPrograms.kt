@file:Suppress("AGGREGATE_CALL_IN_LOOP", "CONSTANT_NEIGHBORING")

package org.collektive.conformance.golden

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.FieldEntry
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.exchange
import it.unibo.collektive.aggregate.api.mapNeighborhood
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.aggregate.ids
import it.unibo.collektive.aggregate.toMap
import it.unibo.collektive.aggregate.values
import it.unibo.collektive.stdlib.accumulation.convergeCast
import it.unibo.collektive.stdlib.accumulation.findParent
import it.unibo.collektive.stdlib.accumulation.findParents
import it.unibo.collektive.stdlib.collapse.all
import it.unibo.collektive.stdlib.collapse.countMatching
import it.unibo.collektive.stdlib.collapse.fold
import it.unibo.collektive.stdlib.collapse.idOfMax
import it.unibo.collektive.stdlib.collapse.idOfMaxBy
import it.unibo.collektive.stdlib.collapse.idOfMaxWith
import it.unibo.collektive.stdlib.collapse.idOfMin
import it.unibo.collektive.stdlib.collapse.idOfMinBy
import it.unibo.collektive.stdlib.collapse.idOfMinWith
import it.unibo.collektive.stdlib.collapse.max
import it.unibo.collektive.stdlib.collapse.maxBy
import it.unibo.collektive.stdlib.collapse.maxWith
import it.unibo.collektive.stdlib.collapse.min
import it.unibo.collektive.stdlib.collapse.minBy
import it.unibo.collektive.stdlib.collapse.minWith
import it.unibo.collektive.stdlib.collapse.none
import it.unibo.collektive.stdlib.collapse.product
import it.unibo.collektive.stdlib.collapse.reduce
import it.unibo.collektive.stdlib.collapse.sum
import it.unibo.collektive.stdlib.collapse.valueOfMaxBy
import it.unibo.collektive.stdlib.consensus.boundedElection
import it.unibo.collektive.stdlib.consensus.globalElection
import it.unibo.collektive.stdlib.ints.FieldedInts.toDouble
import it.unibo.collektive.stdlib.processes.timeReplicated
import it.unibo.collektive.stdlib.spreading.bellmanFordGradientCast
import it.unibo.collektive.stdlib.spreading.distanceTo
import it.unibo.collektive.stdlib.spreading.everHappened
import it.unibo.collektive.stdlib.spreading.gossip
import it.unibo.collektive.stdlib.spreading.gossipMax
import it.unibo.collektive.stdlib.spreading.gossipMaxWith
import it.unibo.collektive.stdlib.spreading.gossipMinWith
import it.unibo.collektive.stdlib.spreading.gradientCast
import it.unibo.collektive.stdlib.spreading.hopDistanceTo
import it.unibo.collektive.stdlib.spreading.hopGradientCast
import it.unibo.collektive.stdlib.spreading.intGradientCast
import it.unibo.collektive.stdlib.spreading.isHappeningAnywhere
import it.unibo.collektive.stdlib.spreading.multiGradientCast
import it.unibo.collektive.stdlib.spreading.nonStabilizingGossip
import it.unibo.collektive.stdlib.time.localDeltaTime
import it.unibo.collektive.stdlib.time.sharedClock
import it.unibo.collektive.stdlib.time.sharedTimeLeftTo
import it.unibo.collektive.stdlib.util.replaceMatching
import kotlin.math.hypot
import kotlin.time.Duration.Companion.milliseconds
import kotlin.time.Duration.Companion.seconds
import kotlin.time.Instant

fun Aggregate<Int>.hyp(s: Senses): Field<Int, Double> {
    val me =
        s.x to s.y
    return neighboring(me).mapValues { (x, y) -> hypot(me.first - x, me.second - y) }
}
fun Aggregate<Int>.zeroMetric(s: Senses): Any? = gradientCast(s.isSource, s.number, metric = neighboring(0.0))
fun Aggregate<Int>.zeroDist(s: Senses): Any? = distanceTo(s.isSource, neighboring(0.0)) to
    gradientCast(s.isSource, emptyList<Int>(), neighboring(0.0), accumulateData = { _, _, d -> d + localId })
fun Aggregate<Int>.negMetric(s: Senses): Any? = distanceTo(s.isSource, neighboring(s.number - 5.0))
fun Aggregate<Int>.smallInts(s: Senses): Any? =
    intGradientCast(s.isSource, 0, metric = neighboring(s.number % 3), accumulateData = { a, b, _ ->
        a +
            b
    })
fun Aggregate<Int>.smallIntsD(s: Senses): Any? = intGradientCast(s.isSource, s.number, metric = neighboring(s.number % 3), maxDiameter = 4)
fun Aggregate<Int>.infMetric(s: Senses): Any? = distanceTo(
    s.isSource,
    neighboring(
        if (s.number % 3 ==
            0
        ) {
            Double.POSITIVE_INFINITY
        } else {
            1.0
        },
    ),
)
fun Aggregate<Int>.nanMetric(s: Senses): Any? = distanceTo(s.isSource, neighboring(if (s.number % 5 == 0) Double.NaN else 1.0))
fun Aggregate<Int>.maxAcc(s: Senses): Any? =
    gradientCast(s.isSource, s.number, 0.0, 10.0, hyp(s), accumulateDistance = { a, b -> maxOf(a, b) })
fun Aggregate<Int>.gcPath(s: Senses): Any? = gradientCast(s.isSource, listOf<Int>(), hyp(s), accumulateData = { _, _, d -> d + localId })
fun Aggregate<Int>.gcTwo(s: Senses): Any? = gradientCast(s.id % 7 == 0, localId, hyp(s)) to hopGradientCast(s.id % 5 == 0, localId)
fun Aggregate<Int>.strGc(s: Senses): Any? =
    gradientCast(s.isSource, "s${s.number}", "", "zzzz", neighboring("a"), accumulateDistance = { a, b ->
        a +
            b
    })
fun Aggregate<Int>.mgcD(s: Senses): Any? =
    multiGradientCast(listOf(0, 4), s.number.toDouble(), hyp(s), maxDiameter = 5, accumulateData = { a, b, d ->
        d +
            a -
            b
    }).toSortedMap()
fun Aggregate<Int>.bfInt(s: Senses): Any? =
    bellmanFordGradientCast(s.isSource, s.number, 0, 100, accumulateDistance = { a, b -> a + b }, metric = neighboring(s.number % 4))
fun Aggregate<Int>.electBest(s: Senses): Any? = boundedElection(s.number, 4, selectBest = { a, b -> minOf(a, b) })
fun Aggregate<Int>.electTie(s: Senses): Any? = boundedElection(0, 3) to boundedElection(s.number % 2, 2.0, hyp(s))
fun Aggregate<Int>.electMetric(s: Senses): Any? = boundedElection(s.id, 5, metric = neighboring(s.number % 3)) to globalElection(s.number)
fun Aggregate<Int>.ccComp(s: Senses): Any? = convergeCast(
    listOf(s.id),
    neighboring(hopDistanceTo(s.isSource)),
    compareBy<FieldEntry<Int, Int>> {
        it.value
    }.thenByDescending { it.id },
) { a, b ->
    (
        a +
            b
        ).sorted()
}
fun Aggregate<Int>.ccTies(s: Senses): Any? = convergeCast(listOf(s.id), s.number % 3) { a, b -> (a + b).sorted() }
fun Aggregate<Int>.ccBool(s: Senses): Any? = convergeCast(setOf(s.id), s.isSource) { a, b -> a + b }
fun Aggregate<Int>.parentsP(s: Senses): Any? =
    findParents(neighboring(s.number)) { it.value >= 5 }.sorted() to findParents(s.number).sorted()
fun Aggregate<Int>.parentC(s: Senses): Any? =
    findParent(s.number, compareByDescending { it.value }) to findParent(neighboring(s.number % 2))
fun Aggregate<Int>.gosNone(s: Senses): Any? = gossip(s.number) to gossip(s.number, 1) { a, b -> minOf(a, b) }
fun Aggregate<Int>.gosSum(s: Senses): Any? = gossip(s.number) { a, b -> if ((a + b) % 2 == 0) a else b }
fun Aggregate<Int>.gosWith(s: Senses): Any? = listOf(
    gossipMaxWith(
        s.number,
        compareBy {
            it % 3
        },
    ),
    gossipMinWith("n${s.number}", naturalOrder()),
    gossipMax(s.number to s.id, compareBy { it.second }),
)
fun Aggregate<Int>.gossipMax(v: Pair<Int, Int>, c: Comparator<Pair<Int, Int>>): Any? = gossipMaxWith(v, c, 3)
fun Aggregate<Int>.gosNull(s: Senses): Any? = gossip<Int, Int?>(if (s.number % 2 == 0) null else s.number) { a, b -> a ?: b }
fun Aggregate<Int>.timeFast(s: Senses): Any? =
    sharedTimeLeftTo(Instant.fromEpochMilliseconds(s.milliseconds * (1 + s.id % 3)), 400.milliseconds)
fun Aggregate<Int>.clockSkew(s: Senses): Any? = sharedClock(Instant.fromEpochMilliseconds(s.milliseconds + s.id * 1000L * (s.tick / 5))) to
    localDeltaTime(Instant.fromEpochMilliseconds(s.milliseconds))
fun Aggregate<Int>.replFast(s: Senses): Any? =
    timeReplicated(Instant.fromEpochMilliseconds(s.milliseconds), 3, 400.milliseconds) { nonStabilizingGossip(s.number, ::maxOf) }
fun Aggregate<Int>.replCount(s: Senses): Any? = timeReplicated(Instant.fromEpochMilliseconds(s.milliseconds), 2, 1200.milliseconds) {
    evolve(0) {
        it +
            1
    }
}
fun Aggregate<Int>.replOne(s: Senses): Any? = timeReplicated(Instant.fromEpochMilliseconds(s.milliseconds), 1, 2.seconds) {
    evolve(0) {
        it + 1
    } to helper(s.number)
}
val Aggregate<Int>.prop: Int get() = neighboring(localId).neighbors.size
val Aggregate<Int>.prop2: Int get() = helper(localId)
fun Aggregate<Int>.props(s: Senses): Any? = prop + prop2 to (if (s.flag) prop2 else -prop)
fun Aggregate<Int>.safeCall(s: Senses): Any? =
    s.number.takeIf { it > 3 }?.let { helper(it) } to s.number.takeUnless { it > 3 }?.let { neighboring(it).neighbors.values.sum() }
fun Aggregate<Int>.tryCatch(s: Senses): Any? = try {
    helper(s.number)
} finally {
    neighboring(s.number)
}
fun Aggregate<Int>.whenSubject(s: Senses): Any? = when (val k = helper(s.number)) {
    0, 1 -> "low${helper(k)}"
    in 2..4 -> "mid${neighboring(k).neighbors.size}"
    else -> "high${helper(k)}"
}
fun Aggregate<Int>.whenBool(s: Senses): Any? = when {
    helper(s.number) > 3 -> neighboring(1 + s.number).str()

    neighboring(s.number).neighbors.values.sum() >
        6 -> helper(s.number)

    else -> null
}
fun Aggregate<Int>.andChain(s: Senses): Any? =
    s.flag && helper(s.number) > 1 && neighboring(s.number).neighbors.values.max() > 4 || s.isSource && helper(s.number) > 0
fun Aggregate<Int>.whileLoop(s: Senses): Any? {
    var i = 0
    var r = 0
    while (i <
        1 + s.number % 3
    ) {
        r += alignedOn(i) { helper(s.number) }
        i++
    }
    return r
}
fun Aggregate<Int>.labelReturn(s: Senses): Any? = listOf(1, 2, 3).map l@{
    if (it ==
        s.number % 3
    ) {
        return@l 0
    }
    alignedOn(it) { helper(s.number + it) }
}
fun Aggregate<Int>.defArg(s: Senses, x: Int = helper(s.number), y: Int = x + neighboring(x).neighbors.size): Int = x * 100 + y
fun Aggregate<Int>.defArgs(s: Senses): Any? = listOf(defArg(s), defArg(s, 3), defArg(s, y = 5))
fun Aggregate<Int>.varargs(vararg x: Int): Int = x.mapIndexed { i, v -> alignedOn(i) { helper(v) } }.sum()
fun Aggregate<Int>.varg(s: Senses): Any? = varargs(s.number, s.number + 1) + varargs(*IntArray(s.number % 3) { it })
fun Aggregate<Int>.fref(s: Senses): Any? {
    val f: Aggregate<Int>.(Int) -> Int = if (s.flag) Aggregate<Int>::helper else Aggregate<Int>::twice
    return f(s.number) to
        listOf(s.number).map(::helper)
}
data class Holder(val f: Field<Int, Int>, val n: Int)
fun Aggregate<Int>.holder(s: Senses): Any? {
    val h = Holder(neighboring(s.number), s.number)
    return h.f.alignedMapValues(neighboring(h.n)) { a, b ->
        a -
            b
    }.str() +
        h.copy(n = 1).f.all.values.sum()
}
fun Aggregate<Int>.fieldArg(f: Field<Int, Int>, c: Boolean): Any? = if (c) f.neighbors.values.sum() else f.map { it.value + it.id }.str()
fun Aggregate<Int>.fieldArgs(s: Senses): Any? = fieldArg(neighboring(s.number), s.flag) to fieldArg(f = neighboring(s.id), c = !s.flag)
fun Aggregate<Int>.nestedLam(s: Senses): Any? = run {
    listOf(1).map { a ->
        with(neighboring(s.number)) {
            alignedMapValues(neighboring(a)) { x, y ->
                x *
                    y
            }.str()
        }
    }
}
fun Field<Int, Int>.doubled(): Field<Int, Int> = mapValues { it * 2 }
fun Field<Int, Int>.branchy(c: Boolean): Any? = if (c) doubled().str() else neighbors.values.sum()
fun Aggregate<Int>.fieldExt(s: Senses): Any? = neighboring(s.number).doubled().branchy(s.flag)
fun Aggregate<Int>.letField(s: Senses): Any? =
    neighboring(s.number).let { f -> if (s.flag) f.let { g -> g.neighbors.values.max() } else f.all.values.min() }
fun Aggregate<Int>.alignNested(s: Senses): Any? = alignedOn(s.number % 2) {
    alignedOn("b" to s.number % 3) { helper(s.number) } to
        alignedOn(listOf(s.number % 2, null)) { neighboring(s.number).str() }
}
fun Aggregate<Int>.pivots(s: Senses): Any? = listOf<Any?>(null, 1, 2L, 'c', "s", 1.5, true, 1 to 2, listOf(1), mapOf(1 to 2)).map { p ->
    alignedOn(p) {
        share(0) {
            it.neighbors.size +
                it.local.value % 3
        }
    }
}
fun Aggregate<Int>.shareField(s: Senses): Any? = share(0) { f ->
    val g = f.mapValues { it + 1 }
    if (s.flag) {
        g.neighbors.values.max(0) % 50
    } else {
        g.all.values.sum() %
            50
    }
}
fun Aggregate<Int>.exchBranch(s: Senses): Any? = exchange(s.number) { f ->
    val m = f.neighbors.values.max(0)
    f.map { (id, v) ->
        if (id % 2 ==
            0
        ) {
            v + 1
        } else {
            (m + v) % 17
        }
    }
}.str()
fun Aggregate<Int>.evoBranch(s: Senses): Any? = evolve(0) { x -> if (s.flag) x + helper(s.number) else x - 1 }
fun Aggregate<Int>.shareInEvolve(s: Senses): Any? = evolve(1) { x -> (x + share(0) { f -> f.neighbors.values.sum() % 7 + 1 }) % 100 }
fun Aggregate<Int>.sameNames(s: Senses): Any? = (share(1) { it.local.value + 1 }) to (share(1) { it.local.value + 2 }) to
    listOf(neighboring(1).neighbors.size, neighboring(s.number).neighbors.values.sum())
fun Aggregate<Int>.inlineNested(s: Senses): Any? = inl { inl { helper(s.number) } + inl { 1 } }
fun Aggregate<Int>.recAlign(n: Int, v: Int): Int = if (n <= 0) v else helper(v) + recAlign(n - 1, v)
fun Aggregate<Int>.rec(s: Senses): Any? = recAlign(s.number % 3, s.number)
interface Beh {
    fun Aggregate<Int>.go(x: Int): Int
    val next: Beh?
}
class BehA(override val next: Beh?) : Beh {
    override fun Aggregate<Int>.go(x: Int): Int = helper(x) + (next?.run { go(x + 1) } ?: 0)
}
object BehB : Beh {
    override val next: Beh? = null
    override fun Aggregate<Int>.go(x: Int): Int = neighboring(x).neighbors.values.sum()
}
fun Aggregate<Int>.behs(s: Senses): Any? {
    val b: Beh = if (s.number % 2 ==
        0
    ) {
        BehA(BehB)
    } else {
        BehA(BehA(null))
    }
    return with(b) { go(s.number) }
}
fun Aggregate<Int>.seqs(s: Senses): Any? =
    neighboring(s.number).neighbors.sequence.filter { it.value > 3 }.map { it.id * 2 }.sorted().toList() to
        neighboring(s.number).all.list.map { it.id }
fun Aggregate<Int>.setOrder(s: Senses): Any? = listOf(
    neighboring(s.number).all.ids.list,
    neighboring(s.number).neighbors.values.list,
    neighboring(s.number).neighbors.set.map {
        it.id
    },
    neighboring(s.number).all.toMap(),
)
fun Aggregate<Int>.coll(s: Senses): Any? {
    val f = neighboring(s.number)
    return listOf(
        f.neighbors.idOfMaxBy { it.value % 4 },
        f.neighbors.idOfMinBy {
            it.value %
                4
        },
        f.all.idOfMaxBy {
            it.value % 4
        },
        f.all.idOfMinWith(compareBy { it.value % 3 }), f.neighbors.valueOfMaxBy { it.value % 5 },
        f.neighbors.maxBy {
            it.value %
                2
        }?.id,
        f.neighbors.minWith(compareBy { it.value % 2 })?.id, f.all.maxWith(compareBy { it.value % 2 }).id,
        f.all.minBy {
            it.value %
                2
        }.id,
        f.neighbors.idOfMaxWith(compareBy { it.value % 3 }), f.all.values.product(), f.neighbors.values.sum(),
        f.all.countMatching {
            it.id >
                2
        },
        f.neighbors.fold(1) { a, e -> a * 3 % 31 + e.value },
        f.all.reduce { a, b ->
            if (a.value >
                b.value
            ) {
                a
            } else {
                b
            }
        }.id,
        f.neighbors.values.none { it > 8 }, f.all.all { it.value >= 0 },
    )
}
fun Aggregate<Int>.dbl(s: Senses): Any? {
    val f = neighboring(s.number / 3.0)
    return listOf(
        f.neighbors.values.min(),
        f.neighbors.values.max(),
        f.neighbors.values.sum(),
        f.all.values.product(),
        f.neighbors.values.max(1.0),
        f.neighbors.values.min(0.5),
        f.neighbors.idOfMax(),
        f.neighbors.idOfMin(),
    )
}
fun Aggregate<Int>.repl2(s: Senses): Any? = neighboring(s.number).replaceMatching(-1) { it.id > 5 }.str()
fun Aggregate<Int>.aligned6(s: Senses): Any? {
    val f = neighboring(s.number)
    val g = f.mapValues { it + 1 }
    return f.alignedMap(g, g, f) { id, a, b, c, d ->
        id +
            a * b -
            c +
            d
    }.str() +
        f.alignedMapValues(g, f, g, f, g) { a, b, c, d, e, h -> a + b - c + d - e + h }.str()
}
fun Aggregate<Int>.mapAgg(s: Senses): Any? = neighboring(s.number).map { (id, v) -> v + alignedOn(id) { 1 } }.str()
fun Aggregate<Int>.eqField(s: Senses): Any? = (neighboring(s.number) == neighboring(s.number)) to (neighboring(1) == mapNeighborhood { 1 })
fun Aggregate<Int>.misaligned(s: Senses): Any? {
    val f = neighboring(s.number)
    return if (s.flag) {
        neighboring(1).alignedMapValues(f) { a, b ->
            a +
                b
        }.str()
    } else {
        try {
            f[99].toString()
        } catch (e: NoSuchElementException) {
            "none"
        }
    }
}
fun Aggregate<Int>.isHap(s: Senses): Any? =
    isHappeningAnywhere { helper(s.number) > 4 } to everHappened { neighboring(s.number).neighbors.size > 3 }

/** Programs for rare cases: unusual metrics, equal values, reducers that merge, rare rounds, and fields inside other values. */
val moreGoldenPrograms: Map<String, GoldenProgram> = mapOf(
    "zeroMetric" to Aggregate<Int>::zeroMetric,
    "zeroDist" to Aggregate<Int>::zeroDist,
    "negMetric" to Aggregate<Int>::negMetric,
    "smallInts" to Aggregate<Int>::smallInts,
    "smallIntsD" to Aggregate<Int>::smallIntsD,
    "infMetric" to Aggregate<Int>::infMetric,
    "nanMetric" to Aggregate<Int>::nanMetric,
    "maxAcc" to Aggregate<Int>::maxAcc,
    "gcPath" to Aggregate<Int>::gcPath,
    "gcTwo" to Aggregate<Int>::gcTwo,
    "strGc" to Aggregate<Int>::strGc,
    "mgcD" to Aggregate<Int>::mgcD,
    "bfInt" to Aggregate<Int>::bfInt,
    "electBest" to Aggregate<Int>::electBest,
    "electTie" to Aggregate<Int>::electTie,
    "electMetric" to Aggregate<Int>::electMetric,
    "ccComp" to Aggregate<Int>::ccComp,
    "ccTies" to Aggregate<Int>::ccTies,
    "ccBool" to Aggregate<Int>::ccBool,
    "parentsP" to Aggregate<Int>::parentsP,
    "parentC" to Aggregate<Int>::parentC,
    "gosNone" to Aggregate<Int>::gosNone,
    "gosSum" to Aggregate<Int>::gosSum,
    "gosWith" to Aggregate<Int>::gosWith,
    "gosNull" to Aggregate<Int>::gosNull,
    "timeFast" to Aggregate<Int>::timeFast,
    "clockSkew" to Aggregate<Int>::clockSkew,
    "replFast" to Aggregate<Int>::replFast,
    "replCount" to Aggregate<Int>::replCount,
    "replOne" to Aggregate<Int>::replOne,
    "props" to Aggregate<Int>::props,
    "safeCall" to Aggregate<Int>::safeCall,
    "tryCatch" to Aggregate<Int>::tryCatch,
    "whenSubject" to Aggregate<Int>::whenSubject,
    "whenBool" to Aggregate<Int>::whenBool,
    "andChain" to Aggregate<Int>::andChain,
    "whileLoop" to Aggregate<Int>::whileLoop,
    "labelReturn" to Aggregate<Int>::labelReturn,
    "defArgs" to Aggregate<Int>::defArgs,
    "varg" to Aggregate<Int>::varg,
    "fref" to Aggregate<Int>::fref,
    "holder" to Aggregate<Int>::holder,
    "fieldArgs" to Aggregate<Int>::fieldArgs,
    "nestedLam" to Aggregate<Int>::nestedLam,
    "fieldExt" to Aggregate<Int>::fieldExt,
    "letField" to Aggregate<Int>::letField,
    "alignNested" to Aggregate<Int>::alignNested,
    "pivots" to Aggregate<Int>::pivots,
    "shareField" to Aggregate<Int>::shareField,
    "exchBranch" to Aggregate<Int>::exchBranch,
    "evoBranch" to Aggregate<Int>::evoBranch,
    "shareInEvolve" to Aggregate<Int>::shareInEvolve,
    "sameNames" to Aggregate<Int>::sameNames,
    "inlineNested" to Aggregate<Int>::inlineNested,
    "rec" to Aggregate<Int>::rec,
    "behs" to Aggregate<Int>::behs,
    "seqs" to Aggregate<Int>::seqs,
    "setOrder" to Aggregate<Int>::setOrder,
    "coll" to Aggregate<Int>::coll,
    "dbl" to Aggregate<Int>::dbl,
    "repl2" to Aggregate<Int>::repl2,
    "aligned6" to Aggregate<Int>::aligned6,
    "mapAgg" to Aggregate<Int>::mapAgg,
    "eqField" to Aggregate<Int>::eqField,
    "misaligned" to Aggregate<Int>::misaligned,
    "isHap" to Aggregate<Int>::isHap,
)
