package it.unibo.collektive.aggregate.api

/** The body of `evolving`, `exchanging` or `sharing`: maps the old value to the one to store or send and the one to return. */
public typealias YieldingScope<Stored, Return> = YieldingContext<Stored, Return>.(Stored) -> YieldingResult<Stored, Return>

/** Provides [yielding] in the body of `evolving`, `exchanging` and `sharing`. */
public class YieldingContext<Stored, Return> {
    /** Stores or sends the receiver, and returns the result of [toReturn]. */
    public fun Stored.yielding(toReturn: Stored.() -> Return): YieldingResult<Stored, Return> = YieldingResult(this, toReturn())
}

/** The value that a primitive stores or sends, and the one that it returns. */
public data class YieldingResult<out Stored, out Return>(val toSend: Stored, val toReturn: Return)
