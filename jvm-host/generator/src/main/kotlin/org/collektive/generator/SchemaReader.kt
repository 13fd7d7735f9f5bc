package org.collektive.generator

import com.google.flatbuffers.reflection.BaseType
import com.google.flatbuffers.reflection.Schema
import java.nio.ByteBuffer
import java.nio.file.Path
import com.google.flatbuffers.reflection.Enum as BinaryEnum
import com.google.flatbuffers.reflection.Field as BinaryField
import com.google.flatbuffers.reflection.Object as BinaryObject
import com.google.flatbuffers.reflection.Type as BinaryType

/** Reads flatc's binary form of the schema [file]. [core] is the path of `types.fbs`. */
internal class SchemaReader(binary: ByteArray, private val file: Path, private val core: Path) {
    private val schema = Schema.getRootAsSchema(ByteBuffer.wrap(binary))
    private val composites = HashMap<Int, Composite>()
    private val enums = HashMap<Int, EnumType>()

    /** The files for which code is generated: the schema file and the files that it includes, except the core types. */
    val files: List<Path> = (0 until schema.fbsFilesLength())
        .map { plain(schema.fbsFiles(it).filename()) }
        .filter { it != core }

    private val texts by lazy { files.associateWith(SchemaText::read) }

    /** Nesting depth of the type that is being read. */
    private var nesting = 0

    /**
     * Returns the definition of an empty `SensorData` if the schema of a program without sensors omits it, else an empty text. A type that
     * neither the actuator nor the global data contains is probably a misspelt `SensorData`, which [read] reports as missing.
     */
    fun missingSensorData(): String {
        val actuator = root("ActuatorData")
        if (root("SensorData") != null || actuator == null) return ""
        root("GlobalData")
        val areAllUsed = objects().all { (index, type) -> index in composites || plain(type.declarationFile()) == core }
        return if (areAllUsed) "\nnamespace ${actuator.name.namespace}; table SensorData { }\n" else ""
    }

    fun read(): UserSchema {
        checkFile()
        files.forEach(::checkNumbers)
        val sensor = root("SensorData") ?: throw missing("SensorData")
        val actuator = root("ActuatorData") ?: throw missing("ActuatorData")
        val global = root("GlobalData")
        if (sensor.name.namespace != actuator.name.namespace) {
            throw error(
                "SensorData is in namespace ${sensor.name.namespace}, ActuatorData in ${actuator.name.namespace}; use one for both",
                "${actuator.name}",
            )
        }
        if (global != null && global !is TableType) throw error("it must be a table", global.name.toString())
        val reached = composites.values.sortedBy { it.name.toString() }
        val user = UserSchema(
            file.fileName.toString(),
            TypeName(sensor.name.namespace, upperCamel(file.fileName.toString().removeSuffix(".fbs")) + "Schema"),
            sensor,
            actuator,
            global,
            reached.filterIsInstance<StructType>(),
            reached.filterIsInstance<TableType>(),
            enums.values,
        )
        checkRoots(user)
        checkVisible()
        checkEnumValues()
        checkKeys()
        checkExtent(user)
        val generatedTypes = (user.structs + user.tables - user.roots.toSet()).map { "${it.name}Value" } + user.name.toString()
        NameRules(schema, { plain(it) in files }) { name, what -> throw error(what, name) }.check(generatedTypes)
        return user
    }

    /** All tables that [file] defines, sorted by name. */
    fun tables(): List<TableType> = objects()
        .filter { (_, type) -> !type.isStruct && plain(type.declarationFile()) == file }
        .map { (index, _) -> composite(index) as TableType }
        .sortedBy { it.name.toString() }
        .ifEmpty { throw error("it defines no tables") }

    /** Rejects numbers that do not fit into 64 signed bits, and -0.0, because flatc's binary schema silently replaces them with 0. */
    private fun checkNumbers(source: Path) {
        for ((index, line) in texts.getValue(source).sanitized.lines().withIndex()) {
            negativeZero.find(line.substringBefore("//"))?.let {
                throw GeneratorException("${source.fileName}:${index + 1}: the default ${it.groupValues[1]} is not supported; use 0")
            }
            for (match in number.findAll(line.substringBefore("//"))) {
                val text = match.groupValues[1]
                val value = if (text.startsWith("0x", ignoreCase = true)) text.drop(2).toBigInteger(16) else text.toBigInteger()
                if (value.bitLength() > 63) {
                    throw GeneratorException("${source.fileName}:${index + 1}: $text is too large; the maximum is ${Long.MAX_VALUE}")
                }
            }
        }
    }

    private fun root(name: String): Composite? {
        val found = objects().filter { simple(it.second.name()) == name }
        if (found.size > 1) {
            throw error("$name is defined twice: ${found.joinToString(" and ") { it.second.name() }}", found[1].second.name())
        }
        return found.firstOrNull()?.let { composite(it.first) }
    }

    private fun missing(name: String): GeneratorException {
        val others = objects().filter { plain(it.second.declarationFile()) != core }.joinToString { simple(it.second.name()) }
        val has = if (others.isEmpty()) "it defines no types" else "it defines $others"
        return error("$name is missing; add `table $name { ... }` or `struct $name { ... }` ($has)")
    }

    private fun composite(index: Int): Composite {
        composites[index]?.let { return it }
        val source = schema.objects(index)
        val name = name(source.name())
        val documentation = lines(source.documentationLength(), source::documentation)
        val sources = (0 until source.fieldsLength()).map(source::fields).sortedBy { it.id() }
        val type = if (source.isStruct) {
            StructType(name, documentation, plain(source.declarationFile()) == core, source.bytesize(), source.minalign())
        } else {
            TableType(name, documentation, slots(name, sources))
        }
        composites[index] = type
        if (nesting == MAX_DEPTH) throw error(TOO_DEEP, source.name())
        nesting++
        type.fields = sources.filter { !it.deprecated() }.map { field(source, it) }
        nesting--
        if (type is StructType) checkLayout(type)
        return type
    }

    private fun slots(table: TypeName, fields: List<BinaryField>): Int {
        val slots = (fields.maxOfOrNull { it.id() } ?: -1) + 1
        if (slots > MAX_SLOTS) throw error("it has $slots fields, more than $MAX_SLOTS; move some of them to another table", "$table")
        return slots
    }

    private fun field(owner: BinaryObject, source: BinaryField): Field = Field(
        source.name(),
        type(owner, source),
        source.id(),
        source.offset(),
        Default(source.defaultInteger(), source.defaultReal()),
        source.optional() && scalar(source.type().baseType()) != null,
        source.required(),
        lines(source.documentationLength(), source::documentation),
    )

    private fun type(owner: BinaryObject, field: BinaryField): Type {
        val type = field.type()
        val index = type.index()
        return when (type.baseType()) {
            BaseType.String -> StringType

            BaseType.Obj -> composite(index)

            BaseType.Vector -> VectorType(element(owner, field, type))

            // The hidden type field of a union precedes it; the error names the union.
            BaseType.UType -> throw unsupported(owner, field.name().removeSuffix("_type"), UNION)

            BaseType.Union -> throw unsupported(owner, field.name(), UNION)

            BaseType.Array -> throw unsupported(
                owner,
                field.name(),
                "fixed arrays are not supported; use one field for each element, or a vector in a table",
            )

            BaseType.Vector64 -> throw unsupported(owner, field.name(), "64-bit vectors are not supported; use a 32-bit vector")

            else -> scalarOrEnum(type.baseType(), index) ?: throw unsupported(owner, field.name(), "its type is not supported")
        }
    }

    private fun element(owner: BinaryObject, field: BinaryField, type: BinaryType): Type = when (type.element()) {
        BaseType.String -> StringType

        BaseType.Obj -> composite(type.index())

        BaseType.UType -> throw unsupported(owner, field.name().removeSuffix("_type"), UNION)

        BaseType.Union -> throw unsupported(owner, field.name(), UNION)

        else -> scalarOrEnum(type.element(), type.index())
            ?: throw unsupported(owner, field.name(), "vectors of this type are not supported; use a vector of tables")
    }

    private fun scalarOrEnum(base: Byte, index: Int): Type? {
        val scalar = scalar(base) ?: return null
        if (index < 0) return scalar
        return enums.getOrPut(index) { enum(schema.enums(index), scalar) }
    }

    private fun enum(source: BinaryEnum, underlying: Scalar): EnumType {
        val values = (0 until source.valuesLength()).map { source.values(it).name() to source.values(it).value() }
        return EnumType(name(source.name()), underlying, values)
    }

    /** Checks that each field is at the next multiple of its alignment, as the C# runtime places the fields of the mirrors. */
    private fun checkLayout(type: StructType) {
        var end = 0
        var largest = 1
        for (field in type.fields) {
            val (bytes, alignment) = when (val fieldType = field.type) {
                is Scalar -> fieldType.bytes to fieldType.bytes
                is EnumType -> fieldType.underlying.bytes to fieldType.underlying.bytes
                is StructType -> fieldType.bytes to fieldType.alignment
                else -> throw error("structs can contain only scalars, enums and structs", "${type.name}.${field.name}")
            }
            end = aligned(end, alignment)
            if (end != field.offset) break
            end += bytes
            largest = maxOf(largest, alignment)
        }
        if (aligned(end, largest) != type.bytes || largest != type.alignment) {
            throw error("force_align is not supported; remove it", "${type.name}")
        }
    }

    /** Rejects nested root types. Each root type has one class per side, which reads or writes the type only as a whole. */
    private fun checkRoots(user: UserSchema) {
        for (type in user.structs + user.tables) {
            for (field in type.fields) {
                val part = (field.type as? VectorType)?.element ?: field.type
                if (part in user.roots) {
                    val name = (part as Composite).name.simple
                    throw error("$name cannot be nested in another type; use a separate type", "${type.name}.${field.name}")
                }
            }
        }
    }

    /** The schema's class is named after the file, and flatc copies the file identifier into string literals. */
    private fun checkFile() {
        if (!fileName.matches(file.fileName.toString())) {
            throw error(
                "the file name becomes a class name: begin it with a letter, and use only ASCII letters, digits, _ and -",
            )
        }
        val identifier = schema.fileIdent().orEmpty()
        if (!identifier.all { it in 'A'..'Z' || it in 'a'..'z' || it in '0'..'9' }) {
            throw error("the file_identifier may contain only ASCII letters and digits; correct or remove it")
        }
    }

    /** Rejects private types, because their code does not compile together with the code of public types. */
    private fun checkVisible() {
        for (type in objects().map { it.second }) {
            if (type.attributesByKey("private") != null) throw error("private types are not supported; remove the attribute", type.name())
        }
        for (enum in (0 until schema.enumsLength()).map(schema::enums)) {
            if (enum.attributesByKey("private") != null) throw error("private types are not supported; remove the attribute", enum.name())
        }
    }

    /** Rejects flags of bit 63 and values after [Long.MAX_VALUE], because the Java that flatc writes for them does not compile. */
    private fun checkEnumValues() {
        for (enum in (0 until schema.enumsLength()).map(schema::enums)) {
            if (enum.underlyingType().baseType() != BaseType.ULong) continue
            for (value in (0 until enum.valuesLength()).map(enum::values)) {
                if (value.value() >= 0) continue
                throw error("the value is too large; the maximum is ${Long.MAX_VALUE}, or bit 62", "${enum.name()}.${value.name()}")
            }
        }
    }

    /** Rejects key fields, because lists are not sorted, and flatc's functions that search for a key would not find all elements. */
    private fun checkKeys() {
        for (type in objects().map { it.second }) {
            for (field in (0 until type.fieldsLength()).map(type::fields)) {
                if (!field.key()) continue
                throw error("key is not supported, because lists are not sorted; remove it", "${type.name()}.${field.name()}")
            }
        }
    }

    /** Limits the size of the generated code, because nested types can expand to many fields. */
    private fun checkExtent(user: UserSchema) {
        var expandedFields = 0
        fun visit(type: Composite, outer: List<Composite>) {
            if (outer.size > MAX_DEPTH) throw error(TOO_DEEP, "${type.name}")
            for (field in type.fields) {
                if (++expandedFields > MAX_EXPANDED_FIELDS) {
                    throw error(
                        "its nested types expand to more than $MAX_EXPANDED_FIELDS fields; use fewer or flatter types",
                        "${outer.first().name}",
                    )
                }
                val part = (field.type as? VectorType)?.element ?: field.type
                if (part is Composite && part !in outer) visit(part, outer + part)
            }
        }
        for (root in user.roots) visit(root, listOf(root))
        for (struct in user.structs) {
            if (slots(struct) > MAX_PARAMETERS) {
                throw error("its fields need more than $MAX_PARAMETERS parameters in generated code; use a table", "${struct.name}")
            }
        }
        val fields = user.tables.sumOf { it.fields.size }
        if (fields > MAX_FIELDS) throw error("its tables have $fields fields, more than $MAX_FIELDS; remove some")
    }

    /** Returns the number of JVM parameter slots for the numbers of a struct. Numbers of 64 bits count twice. */
    private fun slots(struct: StructType): Int = struct.fields.sumOf { field ->
        when (val type = field.type) {
            is StructType -> slots(type)
            is Scalar -> if (type.bytes == Long.SIZE_BYTES || type == Scalar.UINT) 2 else 1
            is EnumType -> 2
            else -> 1
        }
    }

    private fun objects() = (0 until schema.objectsLength()).map { it to schema.objects(it) }

    private fun name(full: String): TypeName {
        if ('.' !in full) throw error("it has no namespace; write `namespace NAME;` before the first type of the file", full)
        return TypeName(full.substringBeforeLast('.'), simple(full))
    }

    private fun unsupported(owner: BinaryObject, field: String, what: String): GeneratorException = error(what, "${owner.name()}.$field")

    /** An error about the type or field [name], or about the whole schema. */
    private fun error(what: String, name: String = ""): GeneratorException {
        if (name.isEmpty()) return GeneratorException("${file.fileName}:1: $what")
        val isType = (0 until schema.objectsLength()).any { schema.objects(it).name() == name } ||
            (0 until schema.enumsLength()).any { schema.enums(it).name() == name }
        val shown = if (isType) simple(name) else name.split('.').takeLast(2).joinToString(".")
        val place = texts.firstNotNullOfOrNull { (file, text) -> text.lineOf(name)?.let { "${file.fileName}:$it" } } ?: "${file.fileName}:1"
        return GeneratorException("$place: $shown: $what")
    }

    private companion object {
        /** The bridge stores the absence of fields in a 64-bit mask. */
        const val MAX_SLOTS = 64
        const val UNION = "unions are not supported; use one optional table field for each case"

        /** The maximum depth that `FrameChecker` accepts. */
        const val MAX_DEPTH = 64
        const val TOO_DEEP = "types are nested more than $MAX_DEPTH levels deep, which frames do not support; use fewer levels"
        const val MAX_EXPANDED_FIELDS = 20_000

        /** A Java constructor has at most 255 parameters, some of which Kotlin adds. */
        const val MAX_PARAMETERS = 240

        /** One Java method creates the layouts of all tables, and methods have at most 64 KB. */
        const val MAX_FIELDS = 3000
        val fileName = Regex("[A-Za-z][A-Za-z0-9_. -]*")

        /** A default of -0, decimal. */
        val negativeZero = Regex("""=\s*["']?(-(?:0+\.?0*|\.0+)(?:[eE][+-]?[0-9]+)?)(?![0-9a-zA-Z.])""")

        /** A default or enum value, decimal or hexadecimal. */
        val number = Regex("""=\s*\+?(0[xX][0-9a-fA-F]+|[0-9]+)\b(?![.eE])""")

        fun simple(full: String): String = full.substringAfterLast('.')

        fun plain(path: String): Path = Path.of(path.removePrefix("//")).toAbsolutePath().normalize()

        fun aligned(offset: Int, alignment: Int): Int = (offset + alignment - 1) / alignment * alignment

        fun lines(count: Int, line: (Int) -> String): String =
            (0 until count).map { line(it).trim() }.filter { it.isNotEmpty() }.joinToString(" ")

        fun scalar(base: Byte): Scalar? = when (base) {
            BaseType.Bool -> Scalar.BOOL
            BaseType.Byte -> Scalar.BYTE
            BaseType.UByte -> Scalar.UBYTE
            BaseType.Short -> Scalar.SHORT
            BaseType.UShort -> Scalar.USHORT
            BaseType.Int -> Scalar.INT
            BaseType.UInt -> Scalar.UINT
            BaseType.Long -> Scalar.LONG
            BaseType.ULong -> Scalar.ULONG
            BaseType.Float -> Scalar.FLOAT
            BaseType.Double -> Scalar.DOUBLE
            else -> null
        }
    }
}
