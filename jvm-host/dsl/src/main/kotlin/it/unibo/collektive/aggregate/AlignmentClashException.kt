package it.unibo.collektive.aggregate

/** Two primitives ran at one [path] in one round; wrap one of them (or each iteration of a loop) in `alignedOn(key) { }`. */
public class AlignmentClashException(public val path: String) :
    IllegalStateException(
        "two primitives ran at the path '$path' in one round; wrap one of them, or each iteration of a loop, in alignedOn(key) { }",
    )
