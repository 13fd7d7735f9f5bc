@file:CollektiveIgnore("it is alignment itself")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi

/**
 * Runs [body] below [pivot]. The library aligns itself with it, so that its functions mean the same in programs compiled with and
 * without the compiler plugin; unlike `alignedOn` it lets a field out, which is right where every caller goes the same way.
 */
internal inline fun <R> Aggregate<*>.aligned(pivot: String, body: () -> R): R {
    align(pivot)
    try {
        return body()
    } finally {
        dealign()
    }
}
