@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.aggregate

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import org.collektive.alignment.AlignmentStack
import org.collektive.alignment.withPlace

/**
 * A value for this device and one for each neighbour that was aligned where the field was created.
 *
 * A field is immutable and evaluated eagerly. Its neighbours are in ascending order of their ids. The functions passed to `map`,
 * `mapValues` and `alignedMap` run once per entry, neighbours first; primitives inside them are aligned on the entry's id. Two
 * fields are equal when they map the same ids, this device's included, to equal values.
 *
 * A branch is an arm of `if` or `when`, or the right side of `?:`, `&&` or `||`. Conditions are outside, also those of `else if`. Inside
 * a branch or an `alignedOn` body, a field created outside has only the neighbours that entered the same branch or body. Read values of
 * all neighbours before branching:
 *
 * ```
 * val near = seen.neighbors.values.list.min()
 * if (source) 0 else near + 1 // inside `else`, `seen` lacks the sources: they took the other branch
 * ```
 *
 * This also applies to branches inside `map`. Inside `map` of [neighborhood][it.unibo.collektive.aggregate.api.neighborhood] and of other
 * fields without values, a field from outside has the neighbours that entered the branch for any of their entries. Inside `map` of other
 * fields, it has the neighbours that entered the branch for the same entry.
 *
 * @property context the device and the round that the field belongs to.
 */
public class Field<ID : Any, out T> private constructor(
    public val context: Aggregate<ID>,
    private val ids: Array<out Any>,
    // If null, every neighbour has the local value.
    private val neighborValues: Array<out Any?>?,
    /** The value for this device. */
    public val localValue: T,
    /** The [AlignmentStack.region] to which this field is restricted. */
    internal val region: Int,
) {
    /** The local entry. */
    public val local: FieldEntry<ID, T> get() = FieldEntry(context.localId, localValue)

    /** The neighbours' entries. */
    public val neighbors: CollapseNeighbors<FieldEntry<ID, T>> get() = NeighborEntries(this)

    /** The neighbours' entries, then the local one. */
    public val all: CollapseAll<FieldEntry<ID, T>> get() = AllEntries(this)

    /** The number of neighbours. With [neighborId] and [neighborValue], loops over a field allocate no entries. */
    public val neighborCount: Int get() = (neighborValues ?: ids).size

    /** `true` when the field stores one value for all devices, as after [mapToConstant]. */
    public val isConstant: Boolean get() = neighborValues == null

    /** The id of the neighbour at [index], from 0 until [neighborCount], in ascending order of ids. */
    @Suppress("UNCHECKED_CAST")
    public fun neighborId(index: Int): ID = ids[index] as ID

    /** The value for the neighbour at [index], from 0 until [neighborCount]. */
    @Suppress("UNCHECKED_CAST")
    public fun neighborValue(index: Int): T = if (neighborValues == null) localValue else neighborValues[index] as T

    /**
     * The value for the device [id].
     *
     * @throws NoSuchElementException when [id] is neither this device nor an aligned neighbour.
     */
    public operator fun get(id: ID): T {
        if (id == context.localId) return localValue
        val index = indexOf(id)
        if (index < 0) throw NoSuchElementException(context.withPlace("the field has no value for device $id, only for ${all.ids.list}"))
        return valueAt(index)
    }

    /** The value to send to the device [id]: the value for that device, or else the local value. To read a field, use [get]. */
    @DelicateCollektiveApi
    public fun getOrLocal(id: ID): T {
        val index = indexOf(id)
        return if (index < 0) localValue else neighborValue(index)
    }

    /** Returns a field with the result of [transform] for each entry. */
    public fun <R> map(transform: (FieldEntry<ID, T>) -> R): Field<ID, R> = build { transform(entryAt(it)) }

    /** Returns a field with the result of [transform] for each value. */
    public fun <R> mapValues(transform: (T) -> R): Field<ID, R> = build { transform(valueAt(it)) }

    /** Returns a field with the same devices, in which each value is [singleton]. */
    public fun <R> mapToConstant(singleton: R): Field<ID, R> {
        rejectField(context, singleton)
        return Field(context, ids, null, singleton, region)
    }

    /**
     * Returns a field with the result of [transform] for each id, its value in this field and its value in [other].
     *
     * @throws IllegalStateException when the fields have different devices; so do all overloads.
     */
    public fun <A, R> alignedMap(other: Field<ID, A>, transform: (ID, T, A) -> R): Field<ID, R> {
        requireAligned(other)
        return build { transform(idAt(it), valueAt(it), other.valueAt(it)) }
    }

    /** [alignedMap] over three fields. */
    public fun <A, B, R> alignedMap(f1: Field<ID, A>, f2: Field<ID, B>, transform: (ID, T, A, B) -> R): Field<ID, R> {
        requireAligned(f1)
        requireAligned(f2)
        return build { transform(idAt(it), valueAt(it), f1.valueAt(it), f2.valueAt(it)) }
    }

    /** [alignedMap] over four fields. */
    public fun <A, B, C, R> alignedMap(
        f1: Field<ID, A>,
        f2: Field<ID, B>,
        f3: Field<ID, C>,
        transform: (ID, T, A, B, C) -> R,
    ): Field<ID, R> {
        requireAligned(f1)
        requireAligned(f2)
        requireAligned(f3)
        return build { transform(idAt(it), valueAt(it), f1.valueAt(it), f2.valueAt(it), f3.valueAt(it)) }
    }

    /** [alignedMap] over five fields. */
    public fun <A, B, C, D, R> alignedMap(
        f1: Field<ID, A>,
        f2: Field<ID, B>,
        f3: Field<ID, C>,
        f4: Field<ID, D>,
        transform: (ID, T, A, B, C, D) -> R,
    ): Field<ID, R> {
        requireAligned(f1)
        requireAligned(f2)
        requireAligned(f3)
        requireAligned(f4)
        return build { transform(idAt(it), valueAt(it), f1.valueAt(it), f2.valueAt(it), f3.valueAt(it), f4.valueAt(it)) }
    }

    /** [alignedMap] over six fields. */
    public fun <A, B, C, D, E, R> alignedMap(
        f1: Field<ID, A>,
        f2: Field<ID, B>,
        f3: Field<ID, C>,
        f4: Field<ID, D>,
        f5: Field<ID, E>,
        transform: (ID, T, A, B, C, D, E) -> R,
    ): Field<ID, R> {
        requireAligned(f1)
        requireAligned(f2)
        requireAligned(f3)
        requireAligned(f4)
        requireAligned(f5)
        return build {
            transform(idAt(it), valueAt(it), f1.valueAt(it), f2.valueAt(it), f3.valueAt(it), f4.valueAt(it), f5.valueAt(it))
        }
    }

    /** [alignedMap] over seven fields. */
    public fun <A, B, C, D, E, F, R> alignedMap(
        f1: Field<ID, A>,
        f2: Field<ID, B>,
        f3: Field<ID, C>,
        f4: Field<ID, D>,
        f5: Field<ID, E>,
        f6: Field<ID, F>,
        transform: (ID, T, A, B, C, D, E, F) -> R,
    ): Field<ID, R> {
        requireAligned(f1)
        requireAligned(f2)
        requireAligned(f3)
        requireAligned(f4)
        requireAligned(f5)
        requireAligned(f6)
        return build {
            transform(
                idAt(it),
                valueAt(it),
                f1.valueAt(it),
                f2.valueAt(it),
                f3.valueAt(it),
                f4.valueAt(it),
                f5.valueAt(it),
                f6.valueAt(it),
            )
        }
    }

    /** [alignedMap] without the ids. */
    public fun <A, R> alignedMapValues(other: Field<ID, A>, transform: (T, A) -> R): Field<ID, R> =
        alignedMap(other) { _, value, a -> transform(value, a) }

    /** [alignedMapValues] over three fields. */
    public fun <A, B, R> alignedMapValues(f1: Field<ID, A>, f2: Field<ID, B>, transform: (T, A, B) -> R): Field<ID, R> =
        alignedMap(f1, f2) { _, value, va, vb -> transform(value, va, vb) }

    /** [alignedMapValues] over four fields. */
    public fun <A, B, C, R> alignedMapValues(
        f1: Field<ID, A>,
        f2: Field<ID, B>,
        f3: Field<ID, C>,
        transform: (T, A, B, C) -> R,
    ): Field<ID, R> = alignedMap(f1, f2, f3) { _, value, va, vb, vc -> transform(value, va, vb, vc) }

    /** [alignedMapValues] over five fields. */
    public fun <A, B, C, D, R> alignedMapValues(
        f1: Field<ID, A>,
        f2: Field<ID, B>,
        f3: Field<ID, C>,
        f4: Field<ID, D>,
        transform: (T, A, B, C, D) -> R,
    ): Field<ID, R> = alignedMap(f1, f2, f3, f4) { _, value, va, vb, vc, vd -> transform(value, va, vb, vc, vd) }

    /** [alignedMapValues] over six fields. */
    public fun <A, B, C, D, E, R> alignedMapValues(
        f1: Field<ID, A>,
        f2: Field<ID, B>,
        f3: Field<ID, C>,
        f4: Field<ID, D>,
        f5: Field<ID, E>,
        transform: (T, A, B, C, D, E) -> R,
    ): Field<ID, R> = alignedMap(f1, f2, f3, f4, f5) { _, value, va, vb, vc, vd, ve -> transform(value, va, vb, vc, vd, ve) }

    /** [alignedMapValues] over seven fields. */
    public fun <A, B, C, D, E, F, R> alignedMapValues(
        f1: Field<ID, A>,
        f2: Field<ID, B>,
        f3: Field<ID, C>,
        f4: Field<ID, D>,
        f5: Field<ID, E>,
        f6: Field<ID, F>,
        transform: (T, A, B, C, D, E, F) -> R,
    ): Field<ID, R> = alignedMap(f1, f2, f3, f4, f5, f6) { _, value, va, vb, vc, vd, ve, vf -> transform(value, va, vb, vc, vd, ve, vf) }

    override fun equals(other: Any?): Boolean = this === other || other is Field<*, *> && all.toMap() == other.all.toMap()

    override fun hashCode(): Int = all.toMap().hashCode()

    override fun toString(): String = "Field(local=${context.localId}: $localValue, neighbors=${neighbors.toMap()})"

    internal fun inRegion(region: Int): Field<ID, T> =
        if (region == this.region) this else Field(context, ids, neighborValues, localValue, region)

    internal fun idAt(index: Int): ID = if (index == ids.size) context.localId else neighborId(index)

    internal fun valueAt(index: Int): T = if (index == ids.size) localValue else neighborValue(index)

    internal fun entryAt(index: Int): FieldEntry<ID, T> = FieldEntry(idAt(index), valueAt(index))

    private inline fun <R> build(value: (Int) -> R): Field<ID, R> {
        val values = arrayOfNulls<Any?>(ids.size)
        for (index in ids.indices) values[index] = alignedAt(index, value)
        return make(context, ids, values, alignedAt(ids.size, value), region)
    }

    private inline fun <R> alignedAt(index: Int, value: (Int) -> R): R {
        val stack = context as? AlignmentStack
        val depth = stack?.pushEntry(idAt(index), isConstant) ?: 0
        if (stack == null) context.align(idAt(index))
        try {
            return value(index)
        } finally {
            if (stack == null) context.dealign() else stack.popTo(depth)
        }
    }

    private fun indexOf(id: ID): Int {
        if (id !is Int) return ids.indexOf(id)
        var low = 0
        var high = ids.size - 1
        while (low <= high) {
            val middle = (low + high) ushr 1
            val found = ids[middle] as Int
            if (found == id) return middle
            if (found < id) low = middle + 1 else high = middle - 1
        }
        return -1
    }

    private fun requireAligned(other: Field<ID, *>) {
        check((ids === other.ids || ids.contentEquals(other.ids)) && context.localId == other.context.localId) {
            context.withPlace(
                "fields of different devices cannot be combined: one has values for ${all.ids.list}, " +
                    "the other for ${other.all.ids.list}; create both in the same branch of the program",
            )
        }
    }

    public companion object {
        /**
         * Creates a field of [context]'s device. For implementations of [Aggregate]; programs use `neighboring`.
         *
         * [ids] contains the neighbours' ids but not [context]'s own, in ascending order if they are [Int]s (not checked). `values[i]`
         * is the value of `ids[i]`. The field takes ownership of both arrays: do not change them afterwards.
         *
         * @throws IllegalStateException when a value is itself a [Field].
         */
        @DelicateCollektiveApi
        public fun <ID : Any, T> make(context: Aggregate<ID>, ids: Array<out Any>, values: Array<out Any?>, local: T): Field<ID, T> =
            make(context, ids, values, local, (context as? AlignmentStack)?.region ?: 0)

        private fun <ID : Any, T> make(
            context: Aggregate<ID>,
            ids: Array<out Any>,
            values: Array<out Any?>,
            local: T,
            region: Int,
        ): Field<ID, T> {
            for (value in values) rejectField(context, value)
            rejectField(context, local)
            return Field(context, ids, values, local, region)
        }

        /**
         * Requires that all fields have the same devices.
         *
         * @throws IllegalStateException when they do not.
         */
        public fun <ID : Any> checkAligned(field1: Field<ID, *>, field2: Field<ID, *>, vararg fields: Field<ID, *>) {
            field1.requireAligned(field2)
            for (field in fields) field1.requireAligned(field)
        }

        private fun rejectField(context: Aggregate<*>, value: Any?) {
            check(value !is Field<*, *>) { context.withPlace("a field cannot be a value of a field: $value") }
        }
    }
}
