package org.collektive.generator

/** Builds the model of the Java template. */
internal object Java {
    fun model(schema: UserSchema): Map<String, Any?> {
        val fingerprints = listOfNotNull(schema.sensor, schema.actuator, schema.global)
        val layouts = reachable(fingerprints).filterIsInstance<TableType>()
        val rules = reachable(listOf(schema.actuator)).filter { it === schema.actuator || ruled(it) }
        return mapOf(
            "file" to schema.file,
            "namespace" to schema.name.namespace,
            "name" to schema.name.simple,
            "types" to fingerprints.mapIndexed { i, type ->
                mapOf(
                    "name" to type.name.simple,
                    "hash" to Fingerprint.of(type).toULong().toString(16).padStart(16, '0'),
                    "separator" to if (i == fingerprints.lastIndex) "" else ",",
                )
            },
            "layouts" to layouts.map { Layouts.layout(it, ::constant) },
            "filled" to layouts.filter { it.fields.isNotEmpty() }.map { Layouts.layout(it, ::constant) },
            "anyFilled" to layouts.any { it.fields.isNotEmpty() },
            "sensor" to schema.sensor.name.toString(),
            "actuator" to "${schema.actuator.name}T",
            "reader" to schema.actuator.name.toString(),
            "sensorLayout" to elementLayout(schema.sensor),
            "actuatorLayout" to elementLayout(schema.actuator),
            "writer" to when (val actuator = schema.actuator) {
                is StructType -> "structs(${actuator.name}T.class, ${actuator.bytes}, ${actuator.alignment}"
                is TableType -> "tables(${actuator.name}T.class"
            },
            "rule" to rule(schema.actuator),
            "global" to schema.global?.let { mapOf("layout" to constant(it), "type" to it.name.toString()) },
            "rules" to rules.map(::ruleModel),
        )
    }

    /**
     * Changes flatc's code to write optional scalars that are 0; flatc omits them as if they were absent. [path] is the file's path in
     * the output folder.
     */
    fun keepZeros(schema: UserSchema, path: String, text: String): String {
        val table = schema.tables.find { "${it.name.toString().replace('.', '/')}.java" == path } ?: return text
        return table.fields.filter { it.optional }.fold(text) { code, field ->
            val add = Regex("""(void add${upperCamel(field.name)}\(.*\) \{ builder\.add\w+\()${field.id}, (.*), [^,]*\); }""")
            check(add.containsMatchIn(code)) { "flatc writes ${table.name}.${field.name} in an unknown way" }
            add.replace(code) { "${it.groupValues[1]}${it.groupValues[2]}); builder.slot(${field.id}); }" }
        }
    }

    private fun elementLayout(type: Composite): String = when (type) {
        is StructType -> "${type.bytes}"
        is TableType -> constant(type)
    }

    private fun ruleModel(type: Composite) = mapOf(
        "rule" to rule(type),
        "type" to "${type.name}T",
        "checks" to listOf("if (depth == 0) return ResultRules.TOO_DEEP;").filter { type is TableType } +
            type.fields.mapNotNull { check(type, it) },
    )

    private fun check(owner: Composite, field: Field): String? {
        val value = "data.get${upperCamel(field.name)}()"
        val name = "\"${field.name}\""
        val present = owner is StructType || field.required
        return when (val type = field.type) {
            is Scalar, is EnumType -> null

            is StringType -> fault("ResultRules.string($value, $name, $present)")

            is Composite -> if (!present && !ruled(type)) null else fault("ResultRules.object($value, $name, $present, ${nested(type)})")

            is VectorType -> when (val element = type.element) {
                is StringType -> fault("ResultRules.strings($value, $name, $present)")
                is Composite -> fault("ResultRules.objects($value, $name, $present, ${nested(element)})")
                else -> if (present) fault("ResultRules.object($value, $name, true, null)") else null
            }
        }
    }

    private fun nested(type: Composite): String = if (ruled(type)) "(item) -> ${rule(type)}(item, depth - 1)" else "null"

    private fun fault(call: String) = "{ String fault = $call; if (fault != null) return fault; }"

    /** Whether an object of this type can have a fault; one with scalars only cannot. */
    private fun ruled(type: Composite): Boolean = type is TableType || type.fields.any { it.type is StructType }

    private fun reachable(roots: List<Composite>): List<Composite> {
        val found = LinkedHashSet<Composite>()
        fun visit(type: Type) {
            if (type is VectorType) visit(type.element)
            if (type is Composite && found.add(type)) type.fields.forEach { visit(it.type) }
        }
        roots.forEach(::visit)
        return found.sortedBy { it.name.toString() }
    }

    private fun unique(type: Composite): String = type.name.toString().split('.').joinToString("") { upperCamel(it) }

    private fun rule(type: Composite): String = "fault${unique(type)}"

    private fun constant(type: TableType): String = "LAYOUT_${type.name.toString().replace('.', '_').uppercase()}"
}
