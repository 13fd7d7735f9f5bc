package org.collektive.frames.data

/**
 * Finds faults that classes of results allow but a frame cannot represent: malformed strings, and `null` in vectors that Java made. Called
 * by generated code. Each function returns the path of the field and the fault, or `null`; a field that is `null` is absent.
 */
public object ResultRules {
    /** Greatest depth of nested tables. Detects an object that contains itself. */
    public const val MAX_DEPTH: Int = 64

    /** The fault of an object beyond [MAX_DEPTH]. */
    public const val TOO_DEEP: String = "is nested deeper than $MAX_DEPTH tables"

    /** Checks a string field. */
    public fun string(value: String?, name: String): String? =
        if (value == null || isWellFormed(value)) null else "$name holds half a surrogate pair"

    /** Checks a vector of strings. */
    public fun strings(value: List<String?>?, name: String): String? {
        if (value == null) return null
        for (i in value.indices) {
            val item = value[i] ?: return "$name[$i] is null"
            if (!isWellFormed(item)) return "$name[$i] holds half a surrogate pair"
        }
        return null
    }

    /** Checks a table by [rule]. */
    public inline fun <T : Any> table(value: T?, name: String, rule: (T) -> String?): String? =
        if (value == null) null else rule(value)?.let { join(name, it) }

    /** Checks a vector of structs or tables, each of its elements by [rule]. */
    public inline fun <T : Any> items(value: List<T?>?, name: String, rule: (T) -> String?): String? {
        if (value == null) return null
        for (i in value.indices) {
            val item = value[i] ?: return "$name[$i] is null"
            rule(item)?.let { return join("$name[$i]", it) }
        }
        return null
    }

    @PublishedApi
    internal fun join(path: String, fault: String): String = if (fault == TOO_DEEP) "$path $fault" else "$path.$fault"

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
