@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.neighboring

/** The distance from this device's [position] to each neighbour's position in its last round; 0 to itself. In the unit of [position]. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance2D(position: Point2D): Field<ID, Double> =
    aligned("euclideanDistance2D") { neighboring(position).mapValues { position.distanceTo(it) } }

/** [euclideanDistance2D] for a position of two coordinates. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance2D(position: Pair<Double, Double>): Field<ID, Double> =
    euclideanDistance2D(Point2D(position.first, position.second))

/** [euclideanDistance2D] for the position that [position] returns; called once. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance2D(position: () -> Point2D): Field<ID, Double> = euclideanDistance2D(position())

/** The distance from this device's [position] to each neighbour's position in its last round; 0 to itself. In the unit of [position]. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance3D(position: Point3D): Field<ID, Double> =
    aligned("euclideanDistance3D") { neighboring(position).mapValues { position.distanceTo(it) } }

/** [euclideanDistance3D] for a position of three coordinates. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance3D(position: Triple<Double, Double, Double>): Field<ID, Double> =
    euclideanDistance3D(Point3D(position.first, position.second, position.third))

/** [euclideanDistance3D] for the position that [position] returns; called once. */
public fun <ID : Any> Aggregate<ID>.euclideanDistance3D(position: () -> Point3D): Field<ID, Double> = euclideanDistance3D(position())
