package org.collektive.frames.data

/**
 * Finds faults that flatc's object classes allow but a frame cannot represent: missing required fields, `null` elements of vectors,
 * malformed strings. Called by generated code. Each function returns the path of the field and the fault, or `null`.
 */
public object ResultRules {
    /** Greatest depth of nested tables. Detects an object that contains itself. */
    public const val MAX_DEPTH: Int = 64

    /** The fault of an object beyond [MAX_DEPTH]. */
    public const val TOO_DEEP: String = "is nested deeper than $MAX_DEPTH tables"

    /** Checks one object. */
    public fun interface Rule<T> {
        /** The path of the field and the fault of [item], or `null`. */
        public fun fault(item: T): String?
    }

    /** Checks a string field. */
    @JvmStatic
    public fun string(value: String?, name: String, required: Boolean): String? = when {
        value == null -> if (required) "$name is null" else null
        isWellFormed(value) -> null
        else -> "$name holds half a surrogate pair"
    }

    /** Checks a vector of strings. */
    @JvmStatic
    public fun strings(value: Array<String?>?, name: String, required: Boolean): String? {
        if (value == null) return if (required) "$name is null" else null
        for (i in value.indices) string(value[i], "", true)?.let { return "$name[$i]$it" }
        return null
    }

    /** Checks a struct, a table or a vector of scalars; [rule] checks its content. */
    @JvmStatic
    public fun <T> `object`(value: T?, name: String, required: Boolean, rule: Rule<T>?): String? {
        if (value == null) return if (required) "$name is null" else null
        return rule?.fault(value)?.let { join(name, it) }
    }

    /** Checks a vector of structs or tables. */
    @JvmStatic
    public fun <T> objects(value: Array<T?>?, name: String, required: Boolean, rule: Rule<T>?): String? {
        if (value == null) return if (required) "$name is null" else null
        for (i in value.indices) {
            val item = value[i] ?: return "$name[$i] is null"
            rule?.fault(item)?.let { return join("$name[$i]", it) }
        }
        return null
    }

    private fun join(path: String, fault: String) = if (fault == TOO_DEEP) "$path $fault" else "$path.$fault"

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
