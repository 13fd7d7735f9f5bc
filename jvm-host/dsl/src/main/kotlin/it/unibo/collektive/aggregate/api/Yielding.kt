package it.unibo.collektive.aggregate.api

/** The body of `evolving`, `exchanging` or `sharing`. It maps the old value to the value to store or send and the value to return. */
public typealias YieldingScope<Stored, Return> = YieldingContext<Stored, Return>.(Stored) -> YieldingResult<Stored, Return>

/** Provides [yielding] in the body of `evolving`, `exchanging` and `sharing`. */
public class YieldingContext<Stored, Return> {
    /** Stores or sends the receiver, and returns the result of [toReturn]. */
    public fun Stored.yielding(toReturn: Stored.() -> Return): YieldingResult<Stored, Return> = YieldingResult(this, toReturn())
}

/** The value that a primitive stores or sends, and the value that it returns. */
public data class YieldingResult<out Stored, out Return>(val toSend: Stored, val toReturn: Return)
