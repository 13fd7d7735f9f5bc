package org.collektive.generator

/** Builds the models of the Kotlin templates. */
internal class Kotlin(private val schema: UserSchema) {
    private val results = reachable(listOf(schema.actuator))

    /** The model of the schema's class. */
    fun schema(): Map<String, Any?> {
        val layouts = reachable(schema.roots).filterIsInstance<TableType>()
        return mapOf(
            "file" to schema.file,
            "namespace" to schema.name.namespace,
            "name" to schema.name.simple,
            "types" to schema.roots.map {
                mapOf("name" to it.name.simple, "hash" to Fingerprint.of(it).toULong().toString(16).padStart(16, '0'))
            },
            "layouts" to layouts.map { Layouts.layout(it, ::constant) },
            "filled" to layouts.filter { it.fields.isNotEmpty() }.map { Layouts.layout(it, ::constant) },
            "sensor" to schema.sensor.name.toString(),
            "actuator" to schema.actuator.name.toString(),
            "sensorLayout" to elementLayout(schema.sensor),
            "actuatorLayout" to elementLayout(schema.actuator),
            "structWriter" to (schema.actuator as? StructType)?.let {
                mapOf("bytes" to it.bytes, "alignment" to it.alignment, "puts" to puts(it, "result", 0))
            },
            "tableWriter" to (schema.actuator is TableType),
            "global" to schema.global?.let { mapOf("layout" to constant(it), "type" to it.name.toString()) },
            "tables" to results.filterIsInstance<TableType>().map(::packing),
        )
    }

    /** The models of the result classes, by name. The types of `types.fbs` are part of the product. */
    fun values(): Map<TypeName, Map<String, Any?>> = results.filter { it !is StructType || !it.core }.associate {
        TypeName(it.name.namespace, value(it).substringAfterLast('.')) to
            model(it)
    }

    private fun model(type: Composite): Map<String, Any?> = mapOf(
        "namespace" to type.name.namespace,
        "name" to value(type).substringAfterLast('.'),
        // Arrays are compared by identity, so a class with arrays cannot be compared by value.
        "modifier" to if (type.fields.isEmpty() || type.fields.any { isArray(it.type) }) "" else "data ",
        "documentation" to documentation(type.documentation.ifEmpty { "The value that a program writes as `${type.name.simple}`." }),
        "anyDocumented" to type.fields.any { it.documentation.isNotEmpty() },
        "documented" to type.fields.filter { it.documentation.isNotEmpty() }.map {
            mapOf("member" to lowerCamel(it.name), "documentation" to documentation(it.documentation))
        },
        "annotation" to if (type.fields.any { !it.required }) "@JvmOverloads constructor" else "",
        "fields" to type.fields.map { mapOf("member" to member(it), "type" to kotlin(type, it), "default" to default(type, it)) },
        "anyChecked" to type.fields.any { rangeCheck(it) != null },
        "checks" to type.fields.mapNotNull(::rangeCheck),
    )

    /** Returns the statement that checks the range of an unsigned field, or `null` for other fields. */
    private fun rangeCheck(field: Field): String? {
        val scalar = unsigned(field.type) ?: return null
        val value = if (field.optional) "it" else member(field)
        val number = if (scalar.kotlin == "Long") value else "$value.toLong()"
        val check = "ResultRules.requireUnsigned($number, ${bits(scalar)}, \"${field.name}\")"
        return if (field.optional) "${member(field)}?.let { $check }" else check
    }

    /** Returns the unsigned scalar whose Kotlin type has more values, or `null` for other types. */
    private fun unsigned(type: Type): Scalar? = when (type) {
        is Scalar -> type.takeIf { it == Scalar.UBYTE || it == Scalar.USHORT || it == Scalar.UINT }
        is EnumType -> unsigned(type.underlying)
        else -> null
    }

    private fun bits(type: Scalar) = Byte.SIZE_BITS * type.bytes

    private fun documentation(text: String) = SchemaText.withoutCommentEnds(text)

    private fun kotlin(owner: Composite, field: Field): String = kotlin(field.type) + if (isNullable(owner, field)) "?" else ""

    private fun isNullable(owner: Composite, field: Field): Boolean =
        field.optional || owner is TableType && !field.required && field.type !is Scalar && field.type !is EnumType

    private fun kotlin(type: Type): String = when (type) {
        is Scalar -> type.kotlin
        is EnumType -> type.underlying.kotlin
        is StringType -> "String"
        is Composite -> value(type)
        is VectorType -> if (isArray(type)) "${kotlin(type.element)}Array" else "List<${kotlin(type.element)}>"
    }

    private fun isArray(type: Type) = type is VectorType && (type.element is Scalar || type.element is EnumType)

    private fun default(owner: Composite, field: Field): String = when {
        isNullable(owner, field) -> " = null"

        field.required -> ""

        else -> when (val type = field.type) {
            is Scalar -> " = ${literal(type, field.default)}"
            is EnumType -> " = ${literal(type.underlying, field.default)}"
            is Composite -> " = ${value(type)}()"
            else -> error("${field.name} is stored outside its struct")
        }
    }

    private fun literal(type: Scalar, default: Default): String = when (type) {
        Scalar.BOOL -> "${default.integer != 0L}"

        Scalar.FLOAT -> real(default.real.toFloat().toString(), "Float", "f")

        Scalar.DOUBLE -> real(default.real.toString(), "Double", "")

        // The parser has no literal for the lowest numbers.
        Scalar.LONG, Scalar.ULONG, Scalar.UINT -> if (default.integer == Long.MIN_VALUE) "Long.MIN_VALUE" else "${default.integer}L"

        else -> "${default.integer}"
    }

    private fun real(text: String, type: String, suffix: String): String = when (text) {
        "NaN" -> "$type.NaN"
        "Infinity" -> "$type.POSITIVE_INFINITY"
        "-Infinity" -> "$type.NEGATIVE_INFINITY"
        else -> text + suffix
    }

    /** Statements that write the struct [type], the value of the expression [data], to `target`, [offset] bytes after `place`. */
    private fun puts(type: StructType, data: String, offset: Int): List<String> = type.fields.flatMap { field ->
        val value = "$data.${member(field)}"
        val at = offset + field.offset
        when (val part = field.type) {
            is StructType -> puts(part, value, at)
            is EnumType -> listOf(put(part.underlying, at, value))
            is Scalar -> listOf(put(part, at, value))
            else -> error("${field.name} is stored outside its struct")
        }
    }

    private fun put(type: Scalar, at: Int, value: String): String {
        val (suffix, written) = written(type, value)
        return "target.put$suffix(${if (at == 0) "place" else "place + $at"}, $written)"
    }

    /** The suffix of the buffer's methods for [type], and the expression that they write for [value]. */
    private fun written(type: Scalar, value: String): Pair<String, String> = when (type) {
        Scalar.BOOL -> "" to "(if ($value) 1 else 0).toByte()"
        Scalar.BYTE -> "" to value
        Scalar.UBYTE -> "" to "$value.toByte()"
        Scalar.SHORT -> "Short" to value
        Scalar.USHORT -> "Short" to "$value.toShort()"
        Scalar.INT -> "Int" to value
        Scalar.UINT -> "Int" to "$value.toInt()"
        Scalar.LONG, Scalar.ULONG -> "Long" to value
        Scalar.FLOAT -> "Float" to value
        Scalar.DOUBLE -> "Double" to value
    }

    private fun packing(table: TableType) = mapOf(
        "type" to value(table),
        "slots" to table.slots,
        "children" to table.fields.mapNotNull { child(it) },
        // Fields are added by descending size, which minimises padding.
        "adds" to table.fields.sortedWith(compareBy({ -RowPlaces.alignment(it.type) }, { -it.id })).map { add(it) },
        "checks" to table.fields.mapNotNull { check(it) },
    )

    private fun child(field: Field): String? {
        val creation = when (val type = field.type) {
            is StringType -> "builder.createString(it)"
            is TableType -> "pack(builder, it)"
            is VectorType -> vector(type)
            is Scalar, is EnumType, is StructType -> return null
        }
        val value = "data.${member(field)}"
        return "val child${field.id} = " + if (field.required) "$value.let { $creation }" else "$value?.let { $creation } ?: 0"
    }

    private fun vector(type: VectorType): String = when (val element = type.element) {
        is StringType -> "items -> builder.references(items.size) { builder.createString(items[it]) }"

        is TableType -> "items -> builder.references(items.size) { pack(builder, items[it]) }"

        is StructType ->
            "items -> builder.vector(${element.bytes}, ${element.alignment}, items.size) { i -> items[i].let { ${create(element)} } }"

        is EnumType -> scalars(element.underlying)

        is Scalar -> scalars(element)

        is VectorType -> error("a vector of vectors")
    }

    private fun scalars(type: Scalar): String =
        "items -> builder.vector(${type.bytes}, ${type.bytes}, items.size) { builder.${adder(type)}(${built(type, "items[it]")}) }"

    /** The call that writes `it`, a struct of [type], inline. */
    private fun create(type: StructType): String {
        fun arguments(type: StructType, data: String): List<String> = type.fields.flatMap { field ->
            val value = "$data.${member(field)}"
            (field.type as? StructType)?.let { arguments(it, value) } ?: listOf(value)
        }
        return "${type.name}.create${type.name.simple}(builder, ${arguments(type, "it").joinToString()})"
    }

    private fun add(field: Field): String {
        val value = "data.${member(field)}"
        return when (val type = field.type) {
            is StructType -> {
                val add = "builder.addStruct(${field.id}, ${create(type)}, 0)"
                if (field.required) "$value.let { $add }" else "$value?.let { $add }"
            }

            is EnumType -> addScalar(field, type.underlying, value)

            is Scalar -> addScalar(field, type, value)

            else -> "builder.addOffset(${field.id}, child${field.id}, 0)"
        }
    }

    private fun addScalar(field: Field, type: Scalar, value: String): String {
        val write = "builder.${adder(type)}(${built(type, if (field.optional) "it" else value)}); builder.slot(${field.id})"
        return when {
            // A value that is present is always written, even if it equals the default.
            field.optional -> "$value?.let { $write }"

            // -0.0 is equal to 0.0, so the builder would not write it.
            type.real && field.default.real == 0.0 -> "if ($value.toRawBits() != ${if (type == Scalar.FLOAT) "0" else "0L"}) { $write }"

            else -> "builder.${adder(type)}(${field.id}, ${built(type, value)}, ${builtDefault(type, field.default)})"
        }
    }

    private fun adder(type: Scalar) = "add" + when (type) {
        Scalar.BOOL -> "Boolean"
        else -> written(type, "").first.ifEmpty { "Byte" }
    }

    private fun built(type: Scalar, value: String): String = if (type == Scalar.BOOL) value else written(type, value).second

    /** The default value, converted to the type that the builder compares. */
    private fun builtDefault(type: Scalar, default: Default): String = when (type) {
        Scalar.BOOL -> literal(type, default)
        Scalar.FLOAT -> "${literal(type, default)}.toDouble()"
        Scalar.DOUBLE -> literal(type, default)
        Scalar.BYTE, Scalar.UBYTE -> "${default.integer.toByte()}"
        Scalar.SHORT, Scalar.USHORT -> "${default.integer.toShort()}"
        Scalar.INT, Scalar.UINT -> "${default.integer.toInt()}"
        Scalar.LONG, Scalar.ULONG -> literal(Scalar.LONG, default)
    }

    private fun check(field: Field): String? {
        val value = "data.${member(field)}"
        val name = "\"${field.name}\""
        return when (val type = field.type) {
            is Scalar, is EnumType, is StructType -> null

            is StringType -> fault("string($value, $name)")

            is TableType -> fault("table($value, $name) { fault(it, depth - 1) }")

            is VectorType -> when (type.element) {
                is StringType -> fault("strings($value, $name)")
                is TableType -> fault("items($value, $name) { fault(it, depth - 1) }")
                is StructType -> fault("items($value, $name) { null }")
                else -> unsigned(type.element)?.let { fault("unsigned($value, ${bits(it)}, $name)") }
            }
        }
    }

    private fun fault(call: String) = "ResultRules.$call?.let { return it }"

    private fun elementLayout(type: Composite): String = when (type) {
        is StructType -> "${type.bytes}"
        is TableType -> constant(type)
    }

    private fun value(type: Composite): String = if (type === schema.actuator) "${type.name}" else "${type.name}Value"

    private fun member(field: Field): String = lowerCamel(field.name).let { if (it in ReservedNames.kotlin) "`$it`" else it }

    private fun constant(type: TableType): String = "LAYOUT_${type.name.toString().replace('.', '_').uppercase()}"
}
