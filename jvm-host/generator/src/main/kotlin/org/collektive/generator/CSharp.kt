package org.collektive.generator

/** Builds the models of the C# templates. */
internal class CSharp(private val schema: UserSchema) {
    /**
     * The names of flatc's files that generated code needs: the readers of the actuator table and the tables and structs in it, and all
     * enums.
     */
    private val readers = (reachable(listOfNotNull(schema.actuator as? TableType)).map { it.name } + schema.enums.map { it.name })
        .mapTo(HashSet()) { "${it.toString().replace('.', '/')}.cs" }

    /** The structs and tables that C# writes or copies as a whole. The types of `types.fbs` are part of the product. */
    private val mirrored = schema.structs.filter { !it.core }
    private val drafted = reachable(listOfNotNull(schema.sensor, schema.global)).filterIsInstance<TableType>()

    /** Whether flatc's file at [path] is needed. */
    fun reads(path: String): Boolean = path in readers

    fun mirrors(): Map<TypeName, Map<String, Any?>> = mirrored.associate { written(it) to mirrorModel(it) }

    fun drafts(): Map<TypeName, Map<String, Any?>> = drafted.associate { written(it) to draftModel(it) }

    fun schema(): Map<String, Any?> = mapOf(
        "file" to schema.file,
        "stem" to schema.file.removeSuffix(".fbs"),
        "version" to VERSION,
        "namespace" to schema.name.namespace,
        "name" to schema.name.simple,
        "types" to schema.roots.map {
            mapOf("name" to it.name.simple, "hash" to Fingerprint.of(it).toULong().toString(16).padStart(16, '0'))
        },
        "layouts" to schema.structs.map(::layout),
        "sensors" to when (val sensor = schema.sensor) {
            is StructType -> "Bridge::StructSensorBuffer<${mirror(sensor)}>(${sensor.alignment})"
            is TableType -> "Bridge::TableSensorBuffer<${draft(sensor)}, ${draft(sensor)}.Row>()"
        },
        "actuators" to when (val actuator = schema.actuator) {
            is StructType -> "Bridge::StructActuatorBuffer<${mirror(actuator)}>()"
            is TableType -> "Bridge::TableActuatorBuffer<global::${actuator.name}>(shape0)"
        },
        "shapes" to shapes(schema.actuator),
        "globals" to listOfNotNull(schema.global).map { "Bridge::TableGlobalBuffer<${draft(it)}>()" },
        "drafts" to drafted.map(::draft),
    )

    /**
     * Describes how to copy a table of actuator data from a frame, by the fields that each reachable table stores outside its row. The
     * first table is [actuator].
     */
    private fun shapes(actuator: Composite): List<Map<String, Any?>> {
        val tables = mutableListOf<TableType>()
        fun reach(type: Type) {
            when (type) {
                is VectorType -> reach(type.element)
                is TableType -> if (type !in tables) type.also(tables::add).fields.forEach { reach(it.type) }
                else -> Unit
            }
        }
        if (actuator is TableType) reach(actuator)
        return tables.mapIndexed { index, table ->
            mapOf("index" to index, "calls" to table.fields.mapNotNull { shapeCall(it, tables) }.map { "shape$index.$it" })
        }
    }

    private fun shapeCall(field: Field, tables: List<TableType>): String? = when (val type = field.type) {
        is StringType -> "Text(${field.id})"

        is TableType -> "Table(${field.id}, shape${tables.indexOf(type)})"

        is VectorType -> when (val element = type.element) {
            is StringType -> "Texts(${field.id})"
            is TableType -> "Tables(${field.id}, shape${tables.indexOf(element)})"
            is StructType -> "Values(${field.id}, ${element.bytes})"
            is EnumType -> "Values(${field.id}, ${element.underlying.bytes})"
            is Scalar -> "Values(${field.id}, ${element.bytes})"
            is VectorType -> error("${field.name} is a vector of vectors")
        }

        is Scalar, is EnumType, is StructType -> null
    }

    private fun layout(type: StructType) = mapOf(
        "mirror" to mirror(type),
        "bytes" to type.bytes,
        "fields" to type.fields.map { mapOf("member" to member(type, it), "offset" to it.offset) },
    )

    private fun mirrorModel(type: StructType) = mapOf(
        "namespace" to type.name.namespace,
        "name" to written(type).simple,
        "documentation" to documentation(type.documentation, "Mirror of the struct", type.name.simple),
        "fields" to type.fields.map {
            mapOf(
                "documentation" to documentation(it.documentation, "Field", it.name),
                "type" to csharp(it.type),
                "member" to member(type, it),
            )
        },
        "checks" to type.fields.mapNotNull { finiteCheck(type, it) },
    )

    private fun draftModel(type: TableType): Map<String, Any?> = rowModel(type, RowPlaces(type)) + mapOf(
        "namespace" to type.name.namespace,
        "name" to written(type).simple,
        "documentation" to documentation(type.documentation, "Draft of the table", type.name.simple),
        "fields" to type.fields.map {
            mapOf("documentation" to documentation(it.documentation, "Field", it.name), "declaration" to declaration(type, it))
        },
        "nested" to type.fields.filter { it.type is TableType }.map {
            mapOf(
                "type" to csharp(it.type),
                "member" to member(type, it),
                "plain" to upperCamel(it.name),
                "spare" to "spare${it.id}",
            )
        },
        "clears" to type.fields.map { clear(it, member(type, it)) },
        "checks" to type.fields.mapNotNull { finiteCheck(type, it) },
        "children" to type.fields.mapNotNull { requirement(type, it) } + type.fields.mapNotNull { child(type, it) },
    )

    private fun rowModel(type: TableType, places: RowPlaces): Map<String, Any?> = mapOf(
        "alignment" to places.alignment,
        "bytes" to places.bytes,
        "offsets" to (0 until type.slots).map { slot -> places.offsets.entries.find { it.key.id == slot }?.value ?: 0 },
        "childIds" to type.fields.filter { isChild(it.type) }.map(Field::id),
        "absences" to type.fields.mapNotNull { absence(type, it) },
        "fills" to type.fields.map { "row.Field${it.id} = ${rowValue(it, member(type, it), places.offsets.getValue(it))};" },
        "filled" to places.offsets.isNotEmpty(),
        "places" to
            places.offsets.map { (field, offset) ->
                mapOf("type" to rowType(field.type), "place" to "Field${field.id}", "offset" to offset)
            },
    )

    private fun declaration(owner: TableType, field: Field): String {
        val member = member(owner, field)
        val type = csharp(field.type)
        return when (field.type) {
            is VectorType -> "$type $member { get; } = new $type();"
            is TableType -> "$type $member { get; private set; }"
            is StructType -> if (field.required) "$type $member;" else "$type? $member;"
            is StringType -> "$type $member;"
            is Scalar, is EnumType -> if (field.optional) "$type? $member;" else "$type $member;"
        }
    }

    private fun clear(field: Field, member: String): String = when (val type = field.type) {
        is VectorType -> "$member.Clear();"
        is Scalar -> "$member = ${if (field.optional) "null" else literal(type, field.default)};"
        is EnumType -> "$member = ${if (field.optional) "null" else "(${csharp(type)})(${literal(type.underlying, field.default)})"};"
        is StructType -> "$member = ${if (field.required) "default" else "null"};"
        is StringType, is TableType -> "$member = null;"
    }

    /** Returns the check for NaN and infinity, or `null` if the field cannot contain them or has one of them as its default. */
    private fun finiteCheck(owner: Composite, field: Field): String? {
        val member = member(owner, field)
        val nullable = field.optional || owner is TableType && field.type is StructType && !field.required
        val value = if (nullable) "$member.Value" else member
        val absent = if (nullable) "$member.HasValue && " else ""
        val type = field.type
        return when {
            !canBeNotFinite(type) -> null

            type is Scalar && !field.default.real.isFinite() -> null

            type is Scalar -> "if ($absent!${csharp(type)}.IsFinite($value)) return \"${field.name}\";"

            type is StructType ->
                "if ($absent$value.FindNotFinite() is string path${field.id}) return \"${field.name}.\" + path${field.id};"

            type is TableType -> "if ($member?.FindNotFinite() is string path${field.id}) return \"${field.name}.\" + path${field.id};"

            type is VectorType -> vectorCheck(type, field, member)

            else -> null
        }
    }

    private fun vectorCheck(type: VectorType, field: Field, member: String): String {
        val element = type.element
        val place = "\"${field.name}[\" + i + \"]"
        val body = if (element is Scalar) {
            "if (!${csharp(element)}.IsFinite($member[i])) return $place\";"
        } else {
            "if ($member[i].FindNotFinite() is string path) return $place.\" + path;"
        }
        return "for (var i = 0; i < $member.Count; i++) $body"
    }

    private fun canBeNotFinite(type: Type, seen: Set<Type> = emptySet()): Boolean = when (type) {
        is Scalar -> type.real
        is EnumType, is StringType -> false
        is VectorType -> canBeNotFinite(type.element, seen)
        is Composite -> type !in seen && type.fields.any { canBeNotFinite(it.type, seen + type) }
    }

    private fun requirement(owner: TableType, field: Field): String? {
        val checked = field.type is StringType || field.type is TableType
        if (!field.required || !checked) return null
        return "writer.Require(${member(owner, field)} != null, \"${owner.name.simple}.${field.name}\");"
    }

    private fun child(owner: TableType, field: Field): String? {
        val member = member(owner, field)
        val write = when (val type = field.type) {
            is StringType -> "writer.String($member)"

            is TableType -> "$member == null ? 0 : $member.Write(writer)"

            is VectorType -> when (type.element) {
                is StringType -> "writer.Strings($member, ${field.required}, \"${owner.name.simple}.${field.name}\")"
                is TableType -> "writer.Tables($member, ${field.required})"
                else -> "writer.Values($member, ${field.required}, ${RowPlaces.alignment(type.element)})"
            }

            else -> return null
        }
        return "child${field.id} = $write;"
    }

    private fun isChild(type: Type) = type is StringType || type is TableType || type is VectorType

    private fun absence(owner: TableType, field: Field): String? {
        val member = member(owner, field)
        val condition = when {
            isChild(field.type) -> "child${field.id} == 0"
            field.optional || field.type is StructType && !field.required -> "!$member.HasValue"
            else -> return null
        }
        return "if ($condition) absent |= 1UL << ${field.id};"
    }

    private fun rowType(type: Type): String = when {
        isChild(type) -> "int"
        type == Scalar.BOOL -> "byte"
        type is EnumType -> type.underlying.csharp
        else -> csharp(type)
    }

    private fun rowValue(field: Field, member: String, offset: Int): String {
        val type = field.type
        if (isChild(type)) return "child${field.id} == 0 ? 0 : place - $offset - child${field.id}"
        val value = if (field.optional || type is StructType && !field.required) "$member.GetValueOrDefault()" else member
        return when {
            type == Scalar.BOOL -> "(byte)($value ? 1 : 0)"
            type is EnumType -> "(${type.underlying.csharp})$value"
            else -> value
        }
    }

    private fun literal(type: Scalar, default: Default): String = when (type) {
        Scalar.BOOL -> if (default.integer != 0L) "true" else "false"
        Scalar.FLOAT -> real(default.real.toFloat().toString(), "float", "f")
        Scalar.DOUBLE -> real(default.real.toString(), "double", "")
        Scalar.ULONG -> "${default.integer.toULong()}UL"
        Scalar.LONG -> "${default.integer}L"
        Scalar.UINT -> "${default.integer}U"
        else -> "${default.integer}"
    }

    private fun real(text: String, type: String, suffix: String): String = when (text) {
        "NaN" -> "$type.NaN"
        "Infinity" -> "$type.PositiveInfinity"
        "-Infinity" -> "$type.NegativeInfinity"
        else -> text + suffix
    }

    private fun csharp(type: Type): String = when (type) {
        is Scalar -> type.csharp
        is StringType -> "string"
        is EnumType -> "global::${type.name}"
        is StructType -> mirror(type)
        is TableType -> draft(type)
        is VectorType -> (if (type.element is TableType) "Bridge::DraftTables" else "Bridge::DraftList") + "<${csharp(type.element)}>"
    }

    private fun mirror(type: StructType) = "global::${written(type)}"

    private fun draft(type: TableType) = "global::${written(type)}"

    /** The name of the class that writes [type]. Only root types keep their name; for other types, flatc's reader has that name. */
    private fun written(type: Composite) = if (type in schema.roots) type.name else type.name.copy(simple = "${type.name.simple}Value")

    /** The C# name of a field, with an underscore appended if generated code has a member of that name. */
    private fun member(owner: Composite, field: Field): String {
        val name = upperCamel(field.name)
        val type = written(owner).simple
        val makers = owner.fields.filter { it.type is TableType }.map { "Make${upperCamel(it.name)}" }
        return if (name in TAKEN || name == type || name in makers) "${name}_" else name
    }

    private fun documentation(text: String, kind: String, name: String): String = if (text.isEmpty()) {
        "$kind <c>$name</c>."
    } else {
        SchemaText.withoutLineEnds(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    }

    companion object {
        private val ENUM_READ = Regex("""\(((?:\w+\.)+\w+)\)(__p\.bb\.Get\w*\(o \+ __p\.bb_pos\)) : (\d+);""")
        private val ENUM_ARGUMENT = Regex("""((?:\w+\.)+\w+)( \w+ = )(\d+)([,)])""")
        private val TAKEN = setOf("Clear", "FindNotFinite", "Write", "WriteChildren", "Fill", "Layout", "Row")

        /**
         * Adapts flatc's C# to the package's FlatBuffers assembly: changes the namespace, and defines the symbols used to compile
         * that assembly. Symbols defined in each file need no settings in users' projects. Casts defaults of enums, which flatc writes as
         * integers if they combine several flags.
         */
        fun adapt(text: String): String {
            val header = "// </auto-generated>\n"
            require(header in text) { "flatc's C# has no header" }
            val ours = text.replace("global::Google.", "Google.").replace("Google.FlatBuffers", "global::Collektive.FlatBuffers")
            val cast = ours.replace(ENUM_READ, "($1)$2 : ($1)$3;").replace(ENUM_ARGUMENT, "$1$2($1)$3$4")
            return cast.replaceFirst(header, "$header#define UNSAFE_BYTEBUFFER\n#define ENABLE_SPAN_T\n")
        }
    }
}
