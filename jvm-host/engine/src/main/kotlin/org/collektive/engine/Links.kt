package org.collektive.engine

/** A list of directed links with their values. */
public interface Links {
    /** Number of links. */
    public val size: Int

    /** Returns the id of the sender of link [index]. */
    public fun from(index: Int): Int

    /** Returns the id of the receiver of link [index]. */
    public fun to(index: Int): Int

    /** Returns the length of link [index] in metres, 0 or greater. */
    public fun length(index: Int): Float

    /** Returns the attenuation of link [index], 0 (clear) or greater. */
    public fun attenuation(index: Int): Float
}

internal object NoLinks : Links {
    override val size get() = 0

    override fun from(index: Int) = throw IndexOutOfBoundsException(index)

    override fun to(index: Int) = throw IndexOutOfBoundsException(index)

    override fun length(index: Int) = throw IndexOutOfBoundsException(index)

    override fun attenuation(index: Int) = throw IndexOutOfBoundsException(index)
}

/** A growable list of links. */
public class LinkList : Links {
    private var from = IntArray(16)
    private var to = IntArray(16)
    private var lengths = FloatArray(16)
    private var attenuations = FloatArray(16)

    override var size: Int = 0
        private set

    /** Appends a link from the sender [from] to the receiver [to]: [length] is in metres, [attenuation] 0 (clear) or greater. */
    public fun add(from: Int, to: Int, length: Float, attenuation: Float) {
        if (size == this.from.size) {
            this.from = this.from.copyOf(2 * size)
            this.to = this.to.copyOf(2 * size)
            lengths = lengths.copyOf(2 * size)
            attenuations = attenuations.copyOf(2 * size)
        }
        this.from[size] = from
        this.to[size] = to
        lengths[size] = length
        attenuations[size] = attenuation
        size++
    }

    override fun from(index: Int): Int = from[index]

    override fun to(index: Int): Int = to[index]

    override fun length(index: Int): Float = lengths[index]

    override fun attenuation(index: Int): Float = attenuations[index]

    /** Removes all links. */
    public fun clear() {
        size = 0
    }
}
