package org.collektive.generator

/**
 * Creates the canonical text of a type, and its hash. Texts are equal if and only if both sides read the same bytes under the same
 * names.
 *
 * The text contains the kind, the fields in the order of their ids with offset or id, name, type and default, and nested types inline. A
 * recursive table is written as the number of levels to its outer occurrence.
 */
internal object Fingerprint {
    fun of(type: Composite): Long = hash(text(type))

    fun text(type: Composite): String = buildString { append(type, emptyList()) }

    private fun StringBuilder.append(type: Type, outer: List<Composite>) {
        when (type) {
            is Scalar -> append(type.text)

            is StringType -> append("string")

            is EnumType -> {
                append("enum ").append(type.underlying.text)
                type.values.joinTo(this, ",", "{", "}") { (name, value) -> "$name=$value" }
            }

            is VectorType -> {
                append('[')
                append(type.element, outer)
                append(']')
            }

            is Composite -> {
                val distance = outer.asReversed().indexOf(type)
                if (distance >= 0) append("^").append(distance) else appendFields(type, outer + type)
            }
        }
    }

    private fun StringBuilder.appendFields(type: Composite, outer: List<Composite>) {
        when (type) {
            is StructType -> append("struct ").append(type.bytes)
            is TableType -> append("table")
        }
        append('{')
        for (field in type.fields) {
            append(if (type is StructType) field.offset else field.id).append(' ').append(field.name).append(':')
            append(field.type, outer)
            if (type is TableType) appendPresence(field)
            append(';')
        }
        append('}')
    }

    private fun StringBuilder.appendPresence(field: Field) {
        val scalar = (field.type as? EnumType)?.underlying ?: field.type as? Scalar
        when {
            field.required -> append(" required")
            field.optional -> append("=null")
            scalar != null -> append('=').append(if (scalar.real) text(field.default.real) else field.default.integer)
        }
    }

    /** A text that is the same on all JDKs, unlike `toString`, whose digits changed in JDK 19. */
    private fun text(real: Double): String = java.lang.Double.toHexString(real)

    /** The 64-bit FNV-1a hash of the text in UTF-8. */
    fun hash(text: String): Long {
        var hash = -0x340d631b7bdddcdbL
        for (byte in text.encodeToByteArray()) {
            hash = (hash xor (byte.toLong() and 0xFF)) * 0x100000001b3L
        }
        return hash
    }
}
