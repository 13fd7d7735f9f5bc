package org.collektive.generator

/** A type of a schema, as far as the bridge supports it. */
internal sealed interface Type

/** A number or truth value. [bytes] is its size and its alignment. */
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

/** A struct or a table. [fields] are in the order of their ids and set once, after construction: tables may be recursive. */
internal sealed class Composite(val name: TypeName, val documentation: String) : Type {
    lateinit var fields: List<Field>
}

/** [core]: one of `types.fbs`, whose code is not generated. Sizes in bytes. */
internal class StructType(name: TypeName, documentation: String, val core: Boolean, val bytes: Int, val alignment: Int) :
    Composite(name, documentation)

/** [slots]: fields with the deprecated ones, which are left out of [fields]. */
internal class TableType(name: TypeName, documentation: String, val slots: Int) : Composite(name, documentation)

/**
 * @property id place in the table or struct.
 * @property offset bytes into a struct, or of the entry in a table's vtable.
 * @property optional a scalar that may be absent (`= null`).
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

/** A scalar's default: [real] for float and double, [integer] for all else. */
internal class Default(val integer: Long, val real: Double)

internal data class TypeName(val namespace: String, val simple: String) {
    override fun toString(): String = "$namespace.$simple"
}

/** What the bridge needs to know of a user's schema. [structs] and [tables] are all that can be reached, sorted by name. */
internal class UserSchema(
    val file: String,
    val name: TypeName,
    val sensor: Composite,
    val actuator: Composite,
    val global: TableType?,
    val structs: List<StructType>,
    val tables: List<TableType>,
)
