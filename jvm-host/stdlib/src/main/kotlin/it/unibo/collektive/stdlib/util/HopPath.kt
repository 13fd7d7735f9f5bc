package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable

/**
 * An immutable list of the devices that a value passed, beginning with its origin.
 *
 * A path shares all hops except the last with the path that it extends. [mask] is a Bloom filter of one word. With it, most look-ups of
 * devices that are not on the path need no walk along the path.
 */
@Serializable(with = HopPathSerializer::class)
@PublishedApi
internal class HopPath<ID : Any> private constructor(
    val previous: HopPath<ID>?,
    private val hop: ID?,
    override val size: Int,
    private val mask: Long,
) : AbstractList<ID>() {
    override fun get(index: Int): ID = toList()[index]

    // The inherited iterator calls get for each hop, which takes quadratic time.
    override fun iterator(): Iterator<ID> = toList().iterator()

    operator fun plus(id: ID): HopPath<ID> = HopPath(this, id, size + 1, mask or bitOf(id))

    override fun contains(element: ID): Boolean = prefixUpTo(element) != null

    /** Returns whether this path is [path] with [id] appended. Compares [path] by identity, which takes constant time. */
    fun extends(path: HopPath<ID>, id: ID): Boolean = previous === path && hop == id

    /**
     * Returns whether two paths have their common devices in the same order: this path extended by [last], and [other] extended by
     * [otherLast]. The two last devices must differ.
     */
    fun hasSameHopOrder(last: ID, other: HopPath<ID>, otherLast: ID): Boolean {
        val mine = prefixUpTo(otherLast)
        val others = other.prefixUpTo(last)
        return when {
            mine == null && others == null -> inOrderOf(other, other)
            mine == null -> inOrderOf(others?.previous ?: empty(), other)
            others == null -> other.inOrderOf(mine.previous ?: empty(), this)
            else -> false
        }
    }

    /**
     * Returns whether this path and [whole] have their common devices in the same order, and all of them are in [prefix], with which
     * [whole] begins.
     */
    private fun inOrderOf(prefix: HopPath<ID>, whole: HopPath<ID>): Boolean {
        var mine = this
        var rest = prefix
        while (mine !== rest) {
            val before = mine.previous ?: return true
            val id = mine.hop ?: return true
            val found = rest.prefixUpTo(id)
            if (found != null) {
                rest = found.previous ?: return true
            } else if (rest !== whole && id in whole) {
                return false
            }
            mine = before
        }
        return true
    }

    fun toList(): List<ID> {
        val hops = ArrayList<ID>(size)
        var path: HopPath<ID>? = this
        while (path != null) {
            path.hop?.let(hops::add)
            path = path.previous
        }
        return hops.asReversed()
    }

    override fun equals(other: Any?): Boolean =
        this === other || other is HopPath<*> && size == other.size && mask == other.mask && toList() == other.toList()

    override fun hashCode(): Int = toList().hashCode()

    override fun toString(): String = toList().toString()

    /** Returns the prefix of this path that ends with [id], or `null` if [id] is not on the path. */
    private fun prefixUpTo(id: ID): HopPath<ID>? {
        val bit = bitOf(id)
        var path: HopPath<ID>? = this
        while (path != null && path.mask and bit != 0L) {
            if (path.hop == id) return path
            path = path.previous
        }
        return null
    }

    companion object {
        private val EMPTY = HopPath<Nothing>(null, null, 0, 0)

        /** Returns the path of a value on the device of its origin, which is empty. */
        @Suppress("UNCHECKED_CAST")
        fun <ID : Any> empty(): HopPath<ID> = EMPTY as HopPath<ID>

        /** Returns the path over [hops]. */
        fun <ID : Any> of(hops: List<ID>): HopPath<ID> = hops.fold(empty()) { path, id -> path + id }

        private fun bitOf(id: Any): Long = 1L shl (id.hashCode() * -0x61c88647 ushr 26)
    }
}
