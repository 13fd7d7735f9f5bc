package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable

/**
 * The devices that a value passed, from its origin to the last. Immutable.
 *
 * A path shares all hops but the last with the path that it extends. [mask] is a Bloom filter of one word: it answers most look-ups of
 * devices that are not on the path without a walk.
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

    operator fun plus(id: ID): HopPath<ID> = HopPath(this, id, size + 1, mask or bitOf(id))

    override fun contains(element: ID): Boolean = prefixUpTo(element) != null

    /** Whether this path is [path] with [id] appended. Compares [path] by identity, so it takes constant time. */
    fun extends(path: HopPath<ID>, id: ID): Boolean = previous === path && hop == id

    /**
     * Whether the devices common to this path and [last], and to the [other] path and [otherLast], are in the same order. The last
     * devices differ.
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

    /** Whether the devices common to this path and [whole] are in the same order, and are in [prefix], with which [whole] begins. */
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

    fun toList(): List<ID> = generateSequence(this) { it.previous }.mapNotNull { it.hop }.toList().asReversed()

    override fun equals(other: Any?): Boolean =
        this === other || other is HopPath<*> && size == other.size && mask == other.mask && toList() == other.toList()

    override fun hashCode(): Int = toList().hashCode()

    override fun toString(): String = toList().toString()

    /** The prefix of this path that ends with [id]; `null` when [id] is not on it. */
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

        /** The path of a value on the device where it originates. */
        @Suppress("UNCHECKED_CAST")
        fun <ID : Any> empty(): HopPath<ID> = EMPTY as HopPath<ID>

        /** The path over [hops]. */
        fun <ID : Any> of(hops: List<ID>): HopPath<ID> = hops.fold(empty()) { path, id -> path + id }

        private fun bitOf(id: Any): Long = 1L shl (id.hashCode() * -0x61c88647 ushr 26)
    }
}
