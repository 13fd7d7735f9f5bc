package it.unibo.collektive.aggregate

import it.unibo.collektive.networking.OutboundEnvelope.SharedData
import it.unibo.collektive.networking.PayloadRepresentation
import it.unibo.collektive.path.Path
import org.collektive.alignment.ProgramPlace
import org.collektive.alignment.withPlace

/**
 * Two primitives ran at the same [path] in one round. Wrap one of them, or each iteration of a loop, in `alignedOn(key) { }`.
 *
 * @property path the path of both primitives.
 * @property previous the value that the first primitive sends, or `null`.
 * @property current the initial value of the second primitive, which does not run.
 */
public class AlignmentClashException private constructor(
    public val path: Path,
    public val previous: PayloadRepresentation<*>?,
    public val current: SharedData<*, *>,
    override val message: String,
) : IllegalStateException(message) {
    /** The clash at [path]. */
    public constructor(path: Path, previous: PayloadRepresentation<*>?, current: SharedData<*, *>) :
        this(path, previous, current, "$CLASH, '$path'$HINT")

    /** The clash at [path], which the program reached at [place]. */
    public constructor(path: Path, previous: PayloadRepresentation<*>?, current: SharedData<*, *>, place: ProgramPlace) :
        this(path, previous, current, withPlace(CLASH + HINT, place))

    private companion object {
        const val CLASH = "two primitives ran at the same path in one round"
        const val HINT = "; wrap one of them, or each iteration of a loop, in alignedOn(key) { }"
    }
}
