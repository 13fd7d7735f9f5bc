@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.aggregate

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.YieldingScope

/** A device that runs no rounds. It implements only the members that fields use: the id, the path and the [aligned] neighbours. */
internal class FakeDevice<ID : Any>(override val localId: ID, private val aligned: List<ID> = emptyList()) : Aggregate<ID> {
    private val pivots = ArrayList<Any?>()

    val path: List<Any?> get() = pivots.toList()

    override val inMemoryOnly: Boolean get() = true

    fun <T> field(ids: List<ID>, values: List<T>, local: T): Field<ID, T> =
        Field.make(this, Array<Any>(ids.size) { ids[it] }, Array<Any?>(values.size) { values[it] }, local)

    override fun align(pivot: Any?) {
        pivots += pivot
    }

    override fun dealign() {
        pivots.removeAt(pivots.lastIndex)
    }

    override fun <R> alignedOn(pivot: Any?, body: () -> R): R {
        align(pivot)
        try {
            return body()
        } finally {
            dealign()
        }
    }

    override fun <Shared> neighboring(local: Shared, dataSharingMethod: DataSharingMethod<Shared>): Field<ID, Shared> =
        field(aligned, aligned.map { local }, local)

    override fun <Stored> evolve(initial: Stored, transform: (Stored) -> Stored): Stored = noRounds()

    override fun <Stored, Return> evolving(initial: Stored, transform: YieldingScope<Stored, Return>): Return = noRounds()

    override fun <Shared, Return> exchanging(
        initial: Shared,
        dataSharingMethod: DataSharingMethod<Shared>,
        body: YieldingScope<Field<ID, Shared>, Return>,
    ): Return = noRounds()

    private fun noRounds(): Nothing = throw UnsupportedOperationException("a fake device does not run rounds")
}
