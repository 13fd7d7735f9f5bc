package it.unibo.collektive.aggregate

import org.collektive.alignment.ProgramPlace
import org.collektive.alignment.withPlace

/** Two primitives ran at the same [path] in one round. Wrap one of them, or each iteration of a loop, in `alignedOn(key) { }`. */
public class AlignmentClashException private constructor(public val path: String, message: String) : IllegalStateException(message) {
    public constructor(path: String) : this(path, "$CLASH, '$path'$ADVICE")

    public constructor(place: ProgramPlace) : this(place.path, withPlace(CLASH + ADVICE, place))

    private companion object {
        const val CLASH = "two primitives ran at one path in one round"
        const val ADVICE = "; wrap one of them, or each iteration of a loop, in alignedOn(key) { }"
    }
}
