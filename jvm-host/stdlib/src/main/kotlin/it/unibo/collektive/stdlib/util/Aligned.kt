@file:CollektiveIgnore("it implements alignment")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi

/**
 * Runs [body] below [pivot] in the path.
 *
 * The library aligns its functions explicitly, so they behave the same in programs compiled with and without the compiler plugin. Unlike
 * the body of `alignedOn`, [body] may return a field, because [pivot] is a constant and all callers stay aligned.
 */
internal inline fun <R> Aggregate<*>.aligned(pivot: String, body: () -> R): R {
    align(pivot)
    try {
        return body()
    } finally {
        dealign()
    }
}
