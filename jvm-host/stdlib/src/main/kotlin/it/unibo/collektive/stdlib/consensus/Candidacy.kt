package it.unibo.collektive.stdlib.consensus

import kotlinx.serialization.Serializable

/**
 * The candidacy of a device in an election, as another device has received it.
 *
 * A stronger candidacy is greater than a weaker one. If both are equally strong, the nearer one is greater. `compareTo` ignores
 * [candidate], so it is inconsistent with `equals`.
 *
 * @property candidate the device that stands for election.
 * @property distance the distance from the candidate to this device, in the unit of the election's metric.
 * @property strength the value that the election compares first.
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
