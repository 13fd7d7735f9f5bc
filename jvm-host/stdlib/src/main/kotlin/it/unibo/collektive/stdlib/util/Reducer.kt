package it.unibo.collektive.stdlib.util

/** Makes one value of two. */
public typealias Reducer<T> = (T, T) -> T
