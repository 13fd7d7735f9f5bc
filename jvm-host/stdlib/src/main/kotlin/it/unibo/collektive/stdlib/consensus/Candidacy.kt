package it.unibo.collektive.stdlib.consensus

import kotlinx.serialization.Serializable

/**
 * A claim to lead: the [candidate]'s, of this [strength], seen at this [distance]. Stronger is greater, then nearer; `compareTo` is 0
 * also for two candidates that are equally strong and near.
 */
@Serializable
public data class Candidacy<ID : Any, D : Comparable<D>, S : Comparable<S>>(
    public val candidate: ID,
    public val distance: D,
    public val strength: S,
) : Comparable<Candidacy<ID, D, S>> {
    override fun compareTo(other: Candidacy<ID, D, S>): Int {
        val byStrength = strength.compareTo(other.strength)
        return if (byStrength != 0) byStrength else other.distance.compareTo(distance)
    }
}
