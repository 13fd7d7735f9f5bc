package org.collektive.tools.record

import java.lang.reflect.Modifier

/** Compares objects of flatc's object API, and user data as maps, field by field in the order of the schema. */
internal object ObjectDifference {
    /** Returns the first difference of [left] and [right], or `null`. Ignores the fields [except], such as `inspection.roundNanos`. */
    fun first(left: Any?, right: Any?, owner: String = "", field: String = "", except: Set<String> = emptySet()): Difference? = when {
        left == null && right == null -> null

        left == null || right == null -> Difference(owner, field, text(left), text(right))

        left is IntArray && right is IntArray && field in ID_LISTS -> ofIds(left.toSet(), right.toSet(), field)

        left is List<*> && right is List<*> -> ofArrays(left, right, owner, field)

        left.javaClass.isArray -> ofArrays(items(left), items(right), owner, field)

        isLeaf(left) -> if (left == right) null else Difference(owner, field, text(left), text(right))

        else -> fields(left).zip(fields(right)).firstNotNullOfOrNull { (a, b) ->
            val name = if (field.isEmpty()) a.first else "$field.${a.first}"
            if (name in except) null else first(a.second, b.second, owner, name, except)
        }
    }

    private fun ofIds(left: Set<Int>, right: Set<Int>, field: String): Difference? =
        (left + right).sorted().find { it !in left || it !in right }
            ?.let { Difference("node $it", field, presence(it in left), presence(it in right)) }

    private fun ofArrays(left: List<Any?>, right: List<Any?>, owner: String, field: String): Difference? {
        val owners = (left + right).map { it?.let(::ownerOf) }
        if (owners.isEmpty() || owners.any { it == null } || owner.isNotEmpty()) return ofLists(left, right, owner, field)
        val a = left.associateBy { ownerOf(checkNotNull(it)) }
        val b = right.associateBy { ownerOf(checkNotNull(it)) }
        return (a.keys + b.keys).filterNotNull().sorted().firstNotNullOfOrNull { first(a[it], b[it], it.name, field) }
    }

    private fun ofLists(left: List<Any?>, right: List<Any?>, owner: String, field: String): Difference? =
        (0 until minOf(left.size, right.size)).firstNotNullOfOrNull { first(left[it], right[it], owner, "$field[$it]") }
            ?: if (left.size == right.size) null else Difference(owner, field, "${left.size} elements", "${right.size} elements")

    /** Returns the node or link to which an element of a list belongs, or `null`. Lists of such elements are compared regardless of their order. */
    private fun ownerOf(element: Any): Owner? {
        // Maps are user data, in which the order of a list matters and ids may repeat.
        if (isLeaf(element) || element is List<*> || element is Map<*, *> || element.javaClass.isArray) return null
        val values = fields(element).toMap()
        val from = values["from"]
        val to = values["to"]
        val id = values["id"] ?: values["node"]
        return when {
            from is Int && to is Int -> Owner(from, to)
            id is Int -> Owner(id, null)
            else -> null
        }
    }

    private data class Owner(val first: Int, val second: Int?) : Comparable<Owner> {
        val name get() = if (second == null) "node $first" else "link $first -> $second"

        override fun compareTo(other: Owner) = compareValuesBy(this, other, Owner::first, Owner::second)
    }

    private fun items(array: Any): List<Any?> = List(java.lang.reflect.Array.getLength(array)) { java.lang.reflect.Array.get(array, it) }

    private fun fields(value: Any): List<Pair<String, Any?>> = if (value is Map<*, *>) {
        value.map { (name, content) -> "$name" to content }
    } else {
        value.javaClass.declaredFields.filter { !Modifier.isStatic(it.modifiers) }.onEach { it.isAccessible = true }
            .map { it.name to it.get(value) }
    }

    private fun isLeaf(value: Any) = value is Number || value is String || value is Boolean

    private fun presence(isPresent: Boolean) = if (isPresent) PRESENT else ABSENT

    private fun text(value: Any?): String = when {
        value == null -> ABSENT
        value is String -> "\"$value\""
        isLeaf(value) -> value.toString()
        else -> PRESENT
    }

    private const val PRESENT = "present"
    private const val ABSENT = "absent"

    /** Fields of frames that are lists of node ids. */
    private val ID_LISTS = setOf("nodesRemoved", "due", "nodes")
}
