@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.neighboring

/** The distance from [localPosition] to each neighbour's in its last round; 0 to itself. In the unit of the positions. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance2D(localPosition: Point2D): Field<ID, Double> =
    aligned("euclideanDistance2D") { neighboring(localPosition).mapValues(localPosition::distanceTo) }

/** [euclideanDistance2D] of two coordinates. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance2D(localPosition: Pair<Double, Double>): Field<ID, Double> =
    euclideanDistance2D(Point2D(localPosition))

/** [euclideanDistance2D] of the position that [extractPosition] returns for this device's id. */
public inline fun <ID : Any> Aggregate<ID>.euclideanDistance2D(extractPosition: (ID) -> Point2D): Field<ID, Double> =
    euclideanDistance2D(extractPosition(localId))

/** The distance from [localPosition] to each neighbour's in its last round; 0 to itself. In the unit of the positions. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance3D(localPosition: Point3D): Field<ID, Double> =
    aligned("euclideanDistance3D") { neighboring(localPosition).mapValues(localPosition::distanceTo) }

/** [euclideanDistance3D] of three coordinates. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance3D(localPosition: Triple<Double, Double, Double>): Field<ID, Double> =
    euclideanDistance3D(Point3D(localPosition))

/** [euclideanDistance3D] of the position that [extractPosition] returns for this device's id. */
public inline fun <ID : Any> Aggregate<ID>.euclideanDistance3D(extractPosition: (ID) -> Point3D): Field<ID, Double> =
    euclideanDistance3D(extractPosition(localId))
