package it.unibo.collektive.aggregate.api

/** A step of an `...ing` primitive: from the old value to what is kept (or sent) and what is returned. */
public typealias YieldingScope<Stored, Return> = YieldingContext<Stored, Return>.(Stored) -> YieldingResult<Stored, Return>

/** Gives [yielding] to the body of an `...ing` primitive. */
public class YieldingContext<Stored, Return> {
    /** Keeps (or sends) the receiver and returns the result of [toReturn]. */
    public fun Stored.yielding(toReturn: Stored.() -> Return): YieldingResult<Stored, Return> =
        YieldingResult(this, toReturn())
}

/** What a step keeps or sends, and what it returns. */
public data class YieldingResult<out Stored, out Return>(val toSend: Stored, val toReturn: Return)
