@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.spreading

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.stdlib.ints.FieldedInts.toDouble
import it.unibo.collektive.stdlib.util.hops
import it.unibo.collektive.stdlib.util.nonOverflowingPlus

/**
 * The length of the shortest path to the nearest [source], or [top] when none is reached: the classic gradient. Self-stabilising like
 * [gradientCast].
 *
 * @param bottom the distance of a source to itself, and the lower bound of [metric].
 * @param top infinity: the upper bound of [metric], and the result where no source is reached.
 * @param metric the distances to the neighbours.
 * @param maxDiameter see [gradientCast].
 * @param accumulateDistance adds a distance to a neighbour to the neighbour's distance.
 */
public inline fun <reified ID : Any, reified D : Comparable<D>> Aggregate<ID>.distanceTo(
    source: Boolean,
    bottom: D,
    top: D,
    metric: Field<ID, D>,
    maxDiameter: Int = Int.MAX_VALUE,
    noinline accumulateDistance: (D, D) -> D,
): D = gradientCast(
    source,
    if (source) bottom else top,
    bottom,
    top,
    metric,
    maxDiameter,
    { fromSource, toNeighbor, _ -> accumulateDistance(fromSource, toNeighbor) },
    accumulateDistance,
)

/** [distanceTo] over distances in `0.0..POSITIVE_INFINITY`, by default in hops. */
public inline fun <reified ID : Any> Aggregate<ID>.distanceTo(
    source: Boolean,
    metric: Field<ID, Double> = hops().toDouble(),
    maxDiameter: Int = Int.MAX_VALUE,
): Double = distanceTo(source, 0.0, Double.POSITIVE_INFINITY, metric, maxDiameter, Double::plus)

/**
 * The number of hops to the nearest [source]; 0 at a source, and also where no source is reached. In the latter case, [distanceTo]
 * returns infinity, and `intGradientCast` a value of the caller's choice.
 *
 * @param maxDiameter see [gradientCast].
 */
public inline fun <reified ID : Any> Aggregate<ID>.hopDistanceTo(source: Boolean, maxDiameter: Int = Int.MAX_VALUE): Int =
    hopGradientCast(source, 0, maxDiameter) { fromSource, toNeighbor, _ -> fromSource.nonOverflowingPlus(toNeighbor) }
