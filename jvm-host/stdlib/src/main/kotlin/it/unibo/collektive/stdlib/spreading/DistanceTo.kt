@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.spreading

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.stdlib.ints.FieldedInts.toDouble
import it.unibo.collektive.stdlib.util.hops
import it.unibo.collektive.stdlib.util.nonOverflowingPlus

/**
 * Returns the length of the shortest path to the nearest [source], or [top] if this device cannot reach a source.
 *
 * This is the classic gradient. It stabilises like [gradientCast].
 *
 * @param bottom the distance of a source to itself, and the lower bound of [metric].
 * @param top infinity: the upper bound of [metric], and the result of a device that cannot reach a source.
 * @param metric the distances to the neighbours.
 * @param maxDiameter see [gradientCast].
 * @param accumulateDistance adds the distance to a neighbour to that neighbour's distance from the source.
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

/** Runs [distanceTo] with distances in `0.0..POSITIVE_INFINITY`, which are counted in hops by default. */
public inline fun <reified ID : Any> Aggregate<ID>.distanceTo(
    source: Boolean,
    metric: Field<ID, Double> = hops().toDouble(),
    maxDiameter: Int = Int.MAX_VALUE,
): Double = distanceTo(source, 0.0, Double.POSITIVE_INFINITY, metric, maxDiameter, Double::plus)

/**
 * Returns the number of hops to the nearest [source].
 *
 * The result is 0 at a source, but also on a device that cannot reach a source. To distinguish the two, use [distanceTo], which returns
 * infinity in the latter case, or `intGradientCast`, which returns a value of your choice.
 *
 * @param maxDiameter see [gradientCast].
 */
public inline fun <reified ID : Any> Aggregate<ID>.hopDistanceTo(source: Boolean, maxDiameter: Int = Int.MAX_VALUE): Int =
    hopGradientCast(source, 0, maxDiameter) { fromSource, toNeighbor, _ -> fromSource.nonOverflowingPlus(toNeighbor) }
