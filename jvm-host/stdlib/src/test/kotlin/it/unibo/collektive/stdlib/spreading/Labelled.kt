package it.unibo.collektive.stdlib.spreading

/** A value with a [note] that `equals` ignores. */
internal class Labelled(val id: Int, val note: String) {
    override fun equals(other: Any?): Boolean = other is Labelled && other.id == id

    override fun hashCode(): Int = id
}
