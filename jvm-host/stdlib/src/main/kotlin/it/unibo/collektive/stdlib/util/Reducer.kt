package it.unibo.collektive.stdlib.util

/** Reduces two values to one. */
public typealias Reducer<T> = (T, T) -> T
