@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.aggregate

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import org.collektive.alignment.withPlace

/**
 * A value for this device and one for each neighbour aligned where the field was made.
 *
 * Immutable and evaluated when made; neighbours are in ascending order of their ids. Functions given to `map` and its kin run once
 * per entry, neighbours first, and primitives in them are aligned on the entry's id. Two fields are equal when their maps from id to value are, the local
 * one included.
 *
 * Inside a branch (an arm of `if` or `when`, the right of `?:`, `&&`, `||`) and inside `alignedOn`, a field from outside has only the neighbours that went the
 * same way. So what all need is taken from it before: `val near = seen.neighbors.values.list.min(); if (source) 0 else near + 1`, since inside
 * `else` the sources, which went the other way, are not seen.
 *
 * @property context the device and round that the field belongs to.
 */
public class Field<ID : Any, out T> private constructor(
    public val context: Aggregate<ID>,
    private val ids: Array<out Any>,
    // null: every neighbour's value is the local one.
    private val neighborValues: Array<out Any?>?,
    /** The value for this device. */
    public val localValue: T,
) {
    /** The local entry. */
    public val local: FieldEntry<ID, T> get() = FieldEntry(context.localId, localValue)

    /** The neighbours' entries. */
    public val neighbors: CollapseNeighbors<FieldEntry<ID, T>> get() = NeighborEntries(this)

    /** The neighbours' entries, then the local one. */
    public val all: CollapseAll<FieldEntry<ID, T>> get() = AllEntries(this)

    /** How many neighbours there are; for libraries that cannot afford entries, like the next ones. */
    public val neighborCount: Int get() = (neighborValues ?: ids).size

    /** Whether it is known that all values are one object. */
    public val isConstant: Boolean get() = neighborValues == null

    /** The id of the neighbour [index], below [neighborCount]; ascending as in [neighbors]. */
    @Suppress("UNCHECKED_CAST")
    public fun neighborId(index: Int): ID = ids[index] as ID

    /** The value for the neighbour [index], below [neighborCount]. */
    @Suppress("UNCHECKED_CAST")
    public fun neighborValue(index: Int): T = if (neighborValues == null) localValue else neighborValues[index] as T

    /**
     * The value for the device [id].
     *
     * @throws NoSuchElementException when it is neither this device nor an aligned neighbour.
     */
    public operator fun get(id: ID): T {
        if (id == context.localId) return localValue
        val index = indexOf(id)
        if (index < 0) throw NoSuchElementException(context.withPlace("the field has no value for device $id, only for ${all.ids.list}"))
        return valueAt(index)
    }

    /** The value for the device [id], the local one when it is not in this field: what a receiver [id] gets. */
    @DelicateCollektiveApi
    public fun getOrLocal(id: ID): T {
        val index = indexOf(id)
        return if (index < 0) localValue else neighborValue(index)
    }

    /** A field of [transform] applied to each entry. */
    public fun <R> map(transform: (FieldEntry<ID, T>) -> R): Field<ID, R> = build { transform(entryAt(it)) }

    /** A field of [transform] applied to each value. */
    public fun <R> mapValues(transform: (T) -> R): Field<ID, R> = build { transform(valueAt(it)) }

    /** A field with these devices and one [value]. */
    public fun <R> mapToConstant(value: R): Field<ID, R> {
        refuseField(context, value)
        return Field(context, ids, null, value)
    }

    /**
     * A field of [transform] applied to each id with its value here and in [other].
     *
     * @throws IllegalStateException when the fields are not of the same devices; this holds for all functions of this name.
     */
    public fun <A, R> alignedMap(other: Field<ID, A>, transform: (ID, T, A) -> R): Field<ID, R> {
        requireAligned(other)
        return build { transform(idAt(it), valueAt(it), other.valueAt(it)) }
    }

    /** [alignedMap] over three fields. */
    public fun <A, B, R> alignedMap(a: Field<ID, A>, b: Field<ID, B>, transform: (ID, T, A, B) -> R): Field<ID, R> {
        requireAligned(a)
        requireAligned(b)
        return build { transform(idAt(it), valueAt(it), a.valueAt(it), b.valueAt(it)) }
    }

    /** [alignedMap] over four fields. */
    public fun <A, B, C, R> alignedMap(
        a: Field<ID, A>,
        b: Field<ID, B>,
        c: Field<ID, C>,
        transform: (ID, T, A, B, C) -> R,
    ): Field<ID, R> {
        requireAligned(a)
        requireAligned(b)
        requireAligned(c)
        return build { transform(idAt(it), valueAt(it), a.valueAt(it), b.valueAt(it), c.valueAt(it)) }
    }

    /** [alignedMap] over five fields. */
    public fun <A, B, C, D, R> alignedMap(
        a: Field<ID, A>,
        b: Field<ID, B>,
        c: Field<ID, C>,
        d: Field<ID, D>,
        transform: (ID, T, A, B, C, D) -> R,
    ): Field<ID, R> {
        requireAligned(a)
        requireAligned(b)
        requireAligned(c)
        requireAligned(d)
        return build { transform(idAt(it), valueAt(it), a.valueAt(it), b.valueAt(it), c.valueAt(it), d.valueAt(it)) }
    }

    /** [alignedMap] over six fields. */
    public fun <A, B, C, D, E, R> alignedMap(
        a: Field<ID, A>,
        b: Field<ID, B>,
        c: Field<ID, C>,
        d: Field<ID, D>,
        e: Field<ID, E>,
        transform: (ID, T, A, B, C, D, E) -> R,
    ): Field<ID, R> {
        requireAligned(a)
        requireAligned(b)
        requireAligned(c)
        requireAligned(d)
        requireAligned(e)
        return build {
            transform(idAt(it), valueAt(it), a.valueAt(it), b.valueAt(it), c.valueAt(it), d.valueAt(it), e.valueAt(it))
        }
    }

    /** [alignedMap] over seven fields. */
    public fun <A, B, C, D, E, F, R> alignedMap(
        a: Field<ID, A>,
        b: Field<ID, B>,
        c: Field<ID, C>,
        d: Field<ID, D>,
        e: Field<ID, E>,
        f: Field<ID, F>,
        transform: (ID, T, A, B, C, D, E, F) -> R,
    ): Field<ID, R> {
        requireAligned(a)
        requireAligned(b)
        requireAligned(c)
        requireAligned(d)
        requireAligned(e)
        requireAligned(f)
        return build {
            transform(
                idAt(it), valueAt(it), a.valueAt(it), b.valueAt(it), c.valueAt(it), d.valueAt(it), e.valueAt(it), f.valueAt(it),
            )
        }
    }

    /** [alignedMap] without the ids. */
    public fun <A, R> alignedMapValues(other: Field<ID, A>, transform: (T, A) -> R): Field<ID, R> =
        alignedMap(other) { _, value, a -> transform(value, a) }

    /** [alignedMapValues] over three fields. */
    public fun <A, B, R> alignedMapValues(a: Field<ID, A>, b: Field<ID, B>, transform: (T, A, B) -> R): Field<ID, R> =
        alignedMap(a, b) { _, value, va, vb -> transform(value, va, vb) }

    /** [alignedMapValues] over four fields. */
    public fun <A, B, C, R> alignedMapValues(
        a: Field<ID, A>,
        b: Field<ID, B>,
        c: Field<ID, C>,
        transform: (T, A, B, C) -> R,
    ): Field<ID, R> = alignedMap(a, b, c) { _, value, va, vb, vc -> transform(value, va, vb, vc) }

    /** [alignedMapValues] over five fields. */
    public fun <A, B, C, D, R> alignedMapValues(
        a: Field<ID, A>,
        b: Field<ID, B>,
        c: Field<ID, C>,
        d: Field<ID, D>,
        transform: (T, A, B, C, D) -> R,
    ): Field<ID, R> = alignedMap(a, b, c, d) { _, value, va, vb, vc, vd -> transform(value, va, vb, vc, vd) }

    /** [alignedMapValues] over six fields. */
    public fun <A, B, C, D, E, R> alignedMapValues(
        a: Field<ID, A>,
        b: Field<ID, B>,
        c: Field<ID, C>,
        d: Field<ID, D>,
        e: Field<ID, E>,
        transform: (T, A, B, C, D, E) -> R,
    ): Field<ID, R> = alignedMap(a, b, c, d, e) { _, value, va, vb, vc, vd, ve -> transform(value, va, vb, vc, vd, ve) }

    /** [alignedMapValues] over seven fields. */
    public fun <A, B, C, D, E, F, R> alignedMapValues(
        a: Field<ID, A>,
        b: Field<ID, B>,
        c: Field<ID, C>,
        d: Field<ID, D>,
        e: Field<ID, E>,
        f: Field<ID, F>,
        transform: (T, A, B, C, D, E, F) -> R,
    ): Field<ID, R> =
        alignedMap(a, b, c, d, e, f) { _, value, va, vb, vc, vd, ve, vf -> transform(value, va, vb, vc, vd, ve, vf) }

    override fun equals(other: Any?): Boolean = this === other || other is Field<*, *> && all.toMap() == other.all.toMap()

    override fun hashCode(): Int = all.toMap().hashCode()

    override fun toString(): String = "Field(local=${context.localId}: $localValue, neighbors=${neighbors.toMap()})"

    internal fun idAt(index: Int): ID = if (index == ids.size) context.localId else neighborId(index)

    internal fun valueAt(index: Int): T = if (index == ids.size) localValue else neighborValue(index)

    internal fun entryAt(index: Int): FieldEntry<ID, T> = FieldEntry(idAt(index), valueAt(index))

    private inline fun <R> build(value: (Int) -> R): Field<ID, R> {
        val values = arrayOfNulls<Any?>(ids.size)
        for (index in ids.indices) values[index] = alignedAt(index, value)
        return make(context, ids, values, alignedAt(ids.size, value))
    }

    private inline fun <R> alignedAt(index: Int, value: (Int) -> R): R {
        context.align(idAt(index))
        try {
            return value(index)
        } finally {
            context.dealign()
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
                "fields of different devices cannot be combined: one has values for ${all.ids.list}, the other for ${other.all.ids.list}; " +
                    "make both at one place of the program",
            )
        }
    }

    public companion object {
        /**
         * Makes a field of [context]'s device from its neighbours' [ids] (ascending where they are [Int]s) and their [values].
         *
         * For implementations of [Aggregate], who promise that [context]'s own id is not among [ids]. Both arrays now belong to
         * the field.
         *
         * @throws IllegalStateException when a value is itself a [Field].
         */
        @DelicateCollektiveApi
        public fun <ID : Any, T> make(
            context: Aggregate<ID>,
            ids: Array<out Any>,
            values: Array<out Any?>,
            local: T,
        ): Field<ID, T> {
            for (value in values) refuseField(context, value)
            refuseField(context, local)
            return Field(context, ids, values, local)
        }

        private fun refuseField(context: Aggregate<*>, value: Any?) {
            check(value !is Field<*, *>) { context.withPlace("a field cannot be a value of a field: $value") }
        }
    }
}
