package it.unibo.collektive.stdlib.util

/** Adds an element to what was accumulated. */
public typealias Accumulator<R, T> = (R, T) -> R

/** Adds two elements to what was accumulated. */
public typealias BiAccumulator<R, T, U> = (R, T, U) -> R

/** A condition on two elements. */
public typealias BiPredicate<T, U> = (T, U) -> Boolean

/** Reduces two values to one. */
public typealias Reducer<T> = (T, T) -> T
