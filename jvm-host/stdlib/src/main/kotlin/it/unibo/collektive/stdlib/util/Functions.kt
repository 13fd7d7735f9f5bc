package it.unibo.collektive.stdlib.util

/** A function that adds an element to the value accumulated so far. */
public typealias Accumulator<R, T> = (R, T) -> R

/** A function that adds two elements to the value accumulated so far. */
public typealias BiAccumulator<R, T, U> = (R, T, U) -> R

/** A condition on two elements. */
public typealias BiPredicate<T, U> = (T, U) -> Boolean

/** A function that reduces two values to one. */
public typealias Reducer<T> = (T, T) -> T
