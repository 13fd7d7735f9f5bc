package org.collektive.generator

/** A type of a schema that the bridge supports. */
internal sealed interface Type

/**
 * A number or truth value. [bytes] is both its size and its alignment. [kotlin] is the type in flatc's Java code, a wider one for
 * unsigned numbers.
 */
internal enum class Scalar(val text: String, val csharp: String, val kotlin: String, val bytes: Int) : Type {
    BOOL("bool", "bool", "Boolean", 1),
    BYTE("byte", "sbyte", "Byte", 1),
    UBYTE("ubyte", "byte", "Int", 1),
    SHORT("short", "short", "Short", 2),
    USHORT("ushort", "ushort", "Int", 2),
    INT("int", "int", "Int", 4),
    UINT("uint", "uint", "Long", 4),
    LONG("long", "long", "Long", 8),
    ULONG("ulong", "ulong", "Long", 8),
    FLOAT("float", "float", "Float", 4),
    DOUBLE("double", "double", "Double", 8),
    ;

    val real: Boolean get() = this == FLOAT || this == DOUBLE
}

internal class EnumType(val name: TypeName, val underlying: Scalar, val values: List<Pair<String, Long>>) : Type

internal object StringType : Type

internal class VectorType(val element: Type) : Type

/** A struct or a table. [fields] are in the order of their ids; they are set once, after construction, because tables may be recursive. */
internal sealed class Composite(val name: TypeName, val documentation: String) : Type {
    lateinit var fields: List<Field>
}

/** A struct; [bytes] and [alignment] are in bytes. [core] marks the structs of `types.fbs`, whose code is not generated. */
internal class StructType(name: TypeName, documentation: String, val core: Boolean, val bytes: Int, val alignment: Int) :
    Composite(name, documentation)

/** A table. [slots] is the number of its fields including deprecated ones, which [fields] omits. */
internal class TableType(name: TypeName, documentation: String, val slots: Int) : Composite(name, documentation)

/**
 * A field of a struct or a table.
 *
 * @property id the field's index in the struct or table.
 * @property offset in bytes: of the field in a struct, or of its entry in a table's vtable.
 * @property optional whether it is a scalar that may be absent (`= null`).
 */
internal class Field(
    val name: String,
    val type: Type,
    val id: Int,
    val offset: Int,
    val default: Default,
    val optional: Boolean,
    val required: Boolean,
    val documentation: String,
)

/** A scalar's default: [real] for float and double, [integer] for all others. */
internal class Default(val integer: Long, val real: Double)

internal data class TypeName(val namespace: String, val simple: String) {
    override fun toString(): String = "$namespace.$simple"
}

/** A user's schema. [structs], [tables] and [enums] are reachable from the root types. Structs and tables are sorted by name. */
internal class UserSchema(
    val file: String,
    val name: TypeName,
    val sensor: Composite,
    val actuator: Composite,
    val global: TableType?,
    val structs: List<StructType>,
    val tables: List<TableType>,
    val enums: Collection<EnumType>,
) {
    val roots: List<Composite> = listOfNotNull(sensor, actuator, global)
}

/** Returns [roots] and all structs and tables that they contain, sorted by name. */
internal fun reachable(roots: List<Composite>): List<Composite> {
    val found = LinkedHashSet<Composite>()
    fun visit(type: Type) {
        if (type is VectorType) visit(type.element)
        if (type is Composite && found.add(type)) type.fields.forEach { visit(it.type) }
    }
    roots.forEach(::visit)
    return found.sortedBy { it.name.toString() }
}
