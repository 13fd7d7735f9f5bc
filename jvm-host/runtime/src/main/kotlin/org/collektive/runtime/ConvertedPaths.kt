@file:OptIn(DelicateCollektiveApi::class)

package org.collektive.runtime

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import org.collektive.spi.Conversion
import org.collektive.spi.Conversion.Lost
import java.util.IdentityHashMap

/** Applies a [conversion] to the records of a session, whose paths are in [tree]. */
internal class ConvertedPaths(private val tree: PathTree, private val conversion: Conversion) {
    private val convertedPaths = IdentityHashMap<PathNode, Any>().also { it[tree.root] = tree.root }

    /** Returns the path of the converted tokens of [path], or `null` if one is lost. */
    fun path(path: PathNode): PathNode? = convertedPaths.getOrPut(path) { convert(path) } as? PathNode

    private fun convert(path: PathNode): Any {
        val parent = path(path.parent ?: return path) ?: return Lost
        val token = conversion.token(path.token)
        return if (token === Lost) Lost else tree.enter(parent, token)
    }

    /** Returns the converted stored or sent [value], or [RoundRecord.Nothing] if it is lost. */
    fun value(value: Any?): Any? = when (value) {
        RoundRecord.Nothing -> value
        is AllButOne -> converted(value.value, value.others) { (one, others) -> AllButOne(value.id, one, others) }
        is Field<*, *> -> converted(value)
        else -> conversion.value(value).let { if (it === Lost) RoundRecord.Nothing else it }
    }

    private fun <ID : Any> converted(field: Field<ID, *>): Any {
        val count = field.neighborCount
        return converted(field.localValue, *Array(count) { field.neighborValue(it) }) { values ->
            Field.make(field.context, Array<Any>(count) { field.neighborId(it) }, Array(count) { values[it + 1] }, values[0])
        }
    }

    private inline fun converted(vararg values: Any?, make: (List<Any?>) -> Any): Any {
        val converted = values.map(conversion::value)
        return if (converted.any { it === Lost }) RoundRecord.Nothing else make(converted)
    }
}
