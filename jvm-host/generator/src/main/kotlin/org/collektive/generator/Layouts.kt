package org.collektive.generator

/** Builds the models of generated table layouts in Java. */
internal object Layouts {
    /** The model of the template for `--layouts`. All [tables] are from [file] and in one namespace. */
    fun model(file: String, tables: List<TableType>): Map<String, Any?> = mapOf(
        "file" to file,
        "namespace" to tables.first().name.namespace,
        "name" to name(file).simple,
        "layouts" to tables.map { table -> layout(table, ::shortConstant) + mapOf("entries" to table.fields.map { entry(table, it) }) },
        "filled" to tables.filter { it.fields.isNotEmpty() }.map { layout(it, ::shortConstant) },
    )

    /** The name of the generated class, `FrameLayouts` for `frame.fbs`; [namespace] is the namespace of the tables. */
    fun name(file: String, namespace: String = ""): TypeName = TypeName(namespace, upperCamel(file.removeSuffix(".fbs")) + "Layouts")

    /** The model of the layout of [type]; [constant] returns the constant's name for a table. */
    fun layout(type: TableType, constant: (TableType) -> String): Map<String, Any?> = mapOf(
        "constant" to constant(type),
        "fields" to type.fields.map { field(it, constant) },
    )

    private fun entry(table: TableType, field: Field) =
        mapOf("constant" to "${shortConstant(table)}_${field.name.uppercase()}", "offset" to field.offset)

    private fun shortConstant(type: TableType): String = type.name.simple.replace(Regex("(?<=[a-z0-9])(?=[A-Z])"), "_").uppercase()

    private fun field(field: Field, constant: (TableType) -> String): String {
        val start = "\"${field.name}\", ${field.offset}"
        val end = "${field.required})"
        return when (val type = field.type) {
            is Scalar, is EnumType, is StructType -> "inline($start, ${bytes(type)}, $end"

            is StringType -> "string($start, $end"

            is TableType -> "table($start, ${constant(type)}, $end"

            is VectorType -> when (val element = type.element) {
                is StringType -> "strings($start, $end"
                is TableType -> "tables($start, ${constant(element)}, $end"
                else -> "vector($start, ${bytes(element)}, $end"
            }
        }
    }

    private fun bytes(type: Type): Int = when (type) {
        is Scalar -> type.bytes
        is EnumType -> type.underlying.bytes
        is StructType -> type.bytes
        else -> error("$type is stored outside its table")
    }
}
