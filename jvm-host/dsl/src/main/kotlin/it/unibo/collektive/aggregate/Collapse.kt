package it.unibo.collektive.aggregate

/** A view of a [Field] as a plain collection, in the field's order. Creating a view copies nothing. */
public sealed interface Collapse<out E> {
    /** The elements, ascending by device id. */
    public val list: List<E>

    /** The distinct elements. */
    public val set: Set<E>

    /** The elements, one by one. */
    public val sequence: Sequence<E>

    /** The number of elements. */
    public val size: Int
}

/** The neighbours' elements, without this device's. */
public interface CollapseNeighbors<out E> : Collapse<E>

/** The neighbours' elements, then this device's. */
public interface CollapseAll<out E> : Collapse<E>

/** The entries' ids. */
public val <ID : Any> CollapseNeighbors<FieldEntry<ID, *>>.ids: CollapseNeighbors<ID>
    get() = NeighborIds(list)

/** The entries' ids, this device's last. */
public val <ID : Any> CollapseAll<FieldEntry<ID, *>>.ids: CollapseAll<ID>
    get() = AllIds(list)

/** The entries' values. */
public val <T> CollapseNeighbors<FieldEntry<*, T>>.values: CollapseNeighbors<T>
    get() = NeighborValues(list)

/** The entries' values, this device's last. */
public val <T> CollapseAll<FieldEntry<*, T>>.values: CollapseAll<T>
    get() = AllValues(list)

/** Whether the collection contains [element]. */
public operator fun <E> Collapse<E>.contains(element: E): Boolean = list.contains(element)

/** The entries as a map, in the field's order. */
public fun <ID : Any, T> Collapse<FieldEntry<ID, T>>.toMap(): Map<ID, T> = list.associate { it.id to it.value }

/** The entries as a map, in the sequence's order. */
public fun <ID : Any, T> Sequence<FieldEntry<ID, T>>.toMap(): Map<ID, T> = associate { it.id to it.value }

/** Each view is a separate class, so that the JIT inlines its `get` and a loop over it becomes a loop over the field's arrays. */
internal abstract class View<out E> :
    AbstractList<E>(),
    RandomAccess {
    val list: List<E> get() = this
    val set: Set<E> get() = toSet()
    val sequence: Sequence<E> get() = asSequence()
}

internal class NeighborEntries<ID : Any, T>(private val field: Field<ID, T>) :
    View<FieldEntry<ID, T>>(),
    CollapseNeighbors<FieldEntry<ID, T>> {
    override val size get() = field.neighborCount

    override fun get(index: Int) = FieldEntry(field.neighborId(index), field.neighborValue(index))
}

internal class AllEntries<ID : Any, T>(private val field: Field<ID, T>) :
    View<FieldEntry<ID, T>>(),
    CollapseAll<FieldEntry<ID, T>> {
    override val size get() = field.neighborCount + 1

    override fun get(index: Int) = field.entryAt(index)
}

internal class NeighborIds<ID : Any>(private val entries: List<FieldEntry<ID, *>>) :
    View<ID>(),
    CollapseNeighbors<ID> {
    override val size get() = entries.size

    override fun get(index: Int) = entries[index].id
}

internal class AllIds<ID : Any>(private val entries: List<FieldEntry<ID, *>>) :
    View<ID>(),
    CollapseAll<ID> {
    override val size get() = entries.size

    override fun get(index: Int) = entries[index].id
}

internal class NeighborValues<T>(private val entries: List<FieldEntry<*, T>>) :
    View<T>(),
    CollapseNeighbors<T> {
    override val size get() = entries.size

    override fun get(index: Int) = entries[index].value
}

internal class AllValues<T>(private val entries: List<FieldEntry<*, T>>) :
    View<T>(),
    CollapseAll<T> {
    override val size get() = entries.size

    override fun get(index: Int) = entries[index].value
}
