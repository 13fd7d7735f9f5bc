package it.unibo.collektive.aggregate

/** The elements of a [Field] as a plain collection: a view, in the field's order. */
public sealed interface Collapse<out E> {
    /** The elements, ascending by device id. */
    public val list: List<E>

    /** The distinct elements. */
    public val set: Set<E>

    /** The elements, one by one. */
    public val sequence: Sequence<E>

    /** How many elements there are. */
    public val size: Int

    /** Whether [element] is among them. */
    public operator fun contains(element: @UnsafeVariance E): Boolean
}

/** The neighbours' elements, without the device's own. */
public sealed interface CollapseNeighbors<out E> : Collapse<E>

/** The neighbours' elements, then the device's own. */
public sealed interface CollapseAll<out E> : Collapse<E>

/** The entries' ids. */
public val <ID : Any> CollapseNeighbors<FieldEntry<ID, *>>.ids: CollapseNeighbors<ID>
    get() = NeighborsView(size) { list[it].id }

/** The entries' ids, the own one last. */
public val <ID : Any> CollapseAll<FieldEntry<ID, *>>.ids: CollapseAll<ID>
    get() = AllView(size) { list[it].id }

/** The entries' values. */
public val <T> CollapseNeighbors<FieldEntry<*, T>>.values: CollapseNeighbors<T>
    get() = NeighborsView(size) { list[it].value }

/** The entries' values, the own one last. */
public val <T> CollapseAll<FieldEntry<*, T>>.values: CollapseAll<T>
    get() = AllView(size) { list[it].value }

/** The entries as a map, in the field's order. */
public fun <ID : Any, T> Collapse<FieldEntry<ID, T>>.toMap(): Map<ID, T> = list.associate { it.id to it.value }

internal class NeighborsView<out E>(override val size: Int, private val element: (Int) -> E) :
    AbstractList<E>(),
    CollapseNeighbors<E> {
    override val list get() = this
    override val set get() = toSet()
    override val sequence get() = asSequence()

    override fun get(index: Int): E = element(index)
}

internal class AllView<out E>(override val size: Int, private val element: (Int) -> E) :
    AbstractList<E>(),
    CollapseAll<E> {
    override val list get() = this
    override val set get() = toSet()
    override val sequence get() = asSequence()

    override fun get(index: Int): E = element(index)
}
