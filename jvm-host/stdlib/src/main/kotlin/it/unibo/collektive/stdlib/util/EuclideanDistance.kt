@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.neighboring

/** Returns the distance from [localPosition] to the position of each neighbour in that neighbour's last round, and 0 for this device. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance2D(localPosition: Point2D): Field<ID, Double> =
    aligned("euclideanDistance2D") { neighboring(localPosition).mapValues(localPosition::distanceTo) }

/** Runs [euclideanDistance2D] with a position of two coordinates. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance2D(localPosition: Pair<Double, Double>): Field<ID, Double> =
    euclideanDistance2D(Point2D(localPosition))

/** Runs [euclideanDistance2D] with the position that [extractPosition] returns for this device's id. */
public inline fun <ID : Any> Aggregate<ID>.euclideanDistance2D(extractPosition: (ID) -> Point2D): Field<ID, Double> =
    euclideanDistance2D(extractPosition(localId))

/** Returns the distance from [localPosition] to the position of each neighbour in that neighbour's last round, and 0 for this device. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance3D(localPosition: Point3D): Field<ID, Double> =
    aligned("euclideanDistance3D") { neighboring(localPosition).mapValues(localPosition::distanceTo) }

/** Runs [euclideanDistance3D] with a position of three coordinates. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance3D(localPosition: Triple<Double, Double, Double>): Field<ID, Double> =
    euclideanDistance3D(Point3D(localPosition))

/** Runs [euclideanDistance3D] with the position that [extractPosition] returns for this device's id. */
public inline fun <ID : Any> Aggregate<ID>.euclideanDistance3D(extractPosition: (ID) -> Point3D): Field<ID, Double> =
    euclideanDistance3D(extractPosition(localId))
