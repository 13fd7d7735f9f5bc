package org.collektive.generator

/** A type of a schema that the bridge supports. */
internal sealed interface Type

/** A number or truth value. [bytes] is both its size and its alignment. */
internal enum class Scalar(val text: String, val csharp: String, val bytes: Int) : Type {
    BOOL("bool", "bool", 1),
    BYTE("byte", "sbyte", 1),
    UBYTE("ubyte", "byte", 1),
    SHORT("short", "short", 2),
    USHORT("ushort", "ushort", 2),
    INT("int", "int", 4),
    UINT("uint", "uint", 4),
    LONG("long", "long", 8),
    ULONG("ulong", "ulong", 8),
    FLOAT("float", "float", 4),
    DOUBLE("double", "double", 8),
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

/** A table; [slots] is the number of its fields with the deprecated ones, which [fields] omits. */
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

/** A user's schema. [structs] and [tables] are all that are reachable from the root types, sorted by name. */
internal class UserSchema(
    val file: String,
    val name: TypeName,
    val sensor: Composite,
    val actuator: Composite,
    val global: TableType?,
    val structs: List<StructType>,
    val tables: List<TableType>,
)
