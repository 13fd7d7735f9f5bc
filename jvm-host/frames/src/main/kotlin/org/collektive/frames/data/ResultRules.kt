package org.collektive.frames.data

/**
 * Finds values that a frame cannot represent: unsigned numbers out of range, malformed strings, and `null` in vectors from Java code.
 *
 * Generated code calls it. Each function except [requireUnsigned] returns the path of the field and the error, or `null`. A field that is `null`
 * is absent.
 */
public object ResultRules {
    /** Maximum depth of nested tables. Detects an object that contains itself. */
    public const val MAX_DEPTH: Int = 64

    /** The error about an object beyond [MAX_DEPTH]. */
    public const val TOO_DEEP: String = "is nested deeper than $MAX_DEPTH tables"

    /** Throws an exception if [value] is not an unsigned number of [bits] bits, because a frame would contain another number. */
    public fun requireUnsigned(value: Long, bits: Int, name: String) {
        require(value ushr bits == 0L) { outOfRange(value, bits, name) }
    }

    /** Checks a vector of unsigned numbers of [bits] bits, fewer than 32. */
    public fun unsigned(value: IntArray?, bits: Int, name: String): String? {
        if (value == null) return null
        for (i in value.indices) if (value[i] ushr bits != 0) return outOfRange(value[i].toLong(), bits, "$name[$i]")
        return null
    }

    /** Checks a vector of unsigned numbers of [bits] bits. */
    public fun unsigned(value: LongArray?, bits: Int, name: String): String? {
        if (value == null) return null
        for (i in value.indices) if (value[i] ushr bits != 0L) return outOfRange(value[i], bits, "$name[$i]")
        return null
    }

    /** Checks a string field. */
    public fun string(value: String?, name: String): String? =
        if (value == null || isWellFormed(value)) null else "$name contains an unpaired surrogate"

    /** Checks a vector of strings. */
    public fun strings(value: List<String?>?, name: String): String? {
        if (value == null) return null
        for (i in value.indices) {
            val item = value[i] ?: return "$name[$i] is null"
            if (!isWellFormed(item)) return "$name[$i] contains an unpaired surrogate"
        }
        return null
    }

    /** Checks a table with [rule]. */
    public inline fun <T : Any> table(value: T?, name: String, rule: (T) -> String?): String? =
        if (value == null) null else rule(value)?.let { join(name, it) }

    /** Checks each element of a vector of structs or tables with [rule]. */
    public inline fun <T : Any> items(value: List<T?>?, name: String, rule: (T) -> String?): String? {
        if (value == null) return null
        for (i in value.indices) {
            val item = value[i] ?: return "$name[$i] is null"
            rule(item)?.let { return join("$name[$i]", it) }
        }
        return null
    }

    @PublishedApi
    internal fun join(path: String, problem: String): String = if (problem == TOO_DEEP) "$path $problem" else "$path.$problem"

    private fun outOfRange(value: Long, bits: Int, name: String) = "$name is $value; it must be from 0 to ${(1L shl bits) - 1}"

    private fun isWellFormed(text: String): Boolean {
        var i = 0
        while (i < text.length) {
            val c = text[i++]
            if (c.isLowSurrogate()) return false
            if (c.isHighSurrogate() && (i == text.length || !text[i++].isLowSurrogate())) return false
        }
        return true
    }
}
