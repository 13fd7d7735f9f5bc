package it.unibo.collektive.path

import kotlinx.serialization.Serializable

/** The place where a primitive runs, identified by the tokens on the alignment stack. The same stack gives the same path on all devices. */
@Serializable(with = PathSerializer::class)
public sealed interface Path {
    /** Returns a readable text, with [separator] between the tokens. */
    public fun toMultilineString(separator: String = "\n"): String
}
