package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable

/**
 * The devices that a value came through, from its origin to the last; immutable.
 *
 * A path shares all but its last hop with the path it was made from, and [mask], a Bloom filter of one word, mostly tells at once
 * that a device is not on it.
 */
@Serializable(with = HopPathSerializer::class)
@PublishedApi
internal class HopPath<ID : Any> private constructor(
    val previous: HopPath<ID>?,
    private val hop: ID?,
    val size: Int,
    private val mask: Long,
) {
    operator fun plus(id: ID): HopPath<ID> = HopPath(this, id, size + 1, mask or bitOf(id))

    operator fun contains(id: ID): Boolean = prefixUpTo(id) != null

    /** Whether this is [path] with [id] after it, told without looking at the hops before. */
    fun extends(path: HopPath<ID>, id: ID): Boolean = previous === path && hop == id

    /** Whether those devices that are on both paths come in the same order. */
    fun agreesWith(other: HopPath<ID>): Boolean {
        var mine = this
        var rest = other
        while (mine !== rest) {
            val before = mine.previous ?: return true
            val id = mine.hop ?: return true
            val found = rest.prefixUpTo(id)
            if (found != null) rest = found.previous ?: return true else if (id in other) return false
            mine = before
        }
        return true
    }

    fun toList(): List<ID> = generateSequence(this) { it.previous }.mapNotNull { it.hop }.toList().asReversed()

    override fun equals(other: Any?): Boolean =
        this === other || other is HopPath<*> && size == other.size && mask == other.mask && toList() == other.toList()

    override fun hashCode(): Int = toList().hashCode()

    override fun toString(): String = toList().toString()

    /** The part of this path that ends with [id]. */
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

        /** The path of a value that is where it was made. */
        @Suppress("UNCHECKED_CAST")
        fun <ID : Any> empty(): HopPath<ID> = EMPTY as HopPath<ID>

        private fun bitOf(id: Any): Long = 1L shl (id.hashCode() * -0x61c88647 ushr 26)
    }
}
