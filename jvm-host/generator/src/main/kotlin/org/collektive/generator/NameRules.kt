package org.collektive.generator

import com.google.flatbuffers.reflection.BaseType
import com.google.flatbuffers.reflection.Schema
import com.google.flatbuffers.reflection.Field as BinaryField
import com.google.flatbuffers.reflection.Object as BinaryObject

/**
 * Rejects names that would break the code of flatc or of this generator, or change its meaning.
 *
 * @property isOwn whether code is generated for the file with this path, as flatc writes it.
 * @property reject throws the error about a type, or about a field of a type (`a.b.Type.field`).
 */
internal class NameRules(
    private val schema: Schema,
    private val isOwn: (String) -> Boolean,
    private val reject: (String, String) -> Nothing,
) {
    private val objects = (0 until schema.objectsLength()).map(schema::objects).filter { isOwn(it.declarationFile()) }
    private val enums = (0 until schema.enumsLength()).map(schema::enums).filter { isOwn(it.declarationFile()) }

    /** The first parts of all namespaces that generated code names. */
    private val roots = (
        (0 until schema.objectsLength()).map { schema.objects(it).name() } + (0 until schema.enumsLength()).map { schema.enums(it).name() }
        ).map { it.substringBefore('.') }.toSet()

    /** Checks the types of the user's files, and the names of [generatedTypes]. */
    fun check(generatedTypes: List<String>) {
        for (name in objects.map { it.name() } + enums.map { it.name() }) checkType(name)
        checkDistinct(generatedTypes)
        for (type in objects) checkFields(type)
        for (enum in enums) {
            val values = (0 until enum.valuesLength()).map { enum.values(it).name() }
            for (value in values) {
                checkWord("${enum.name()}.$value", value)
                if (value in ENUM_MEMBERS) reject("${enum.name()}.$value", "generated code has a member of this name; rename the value")
                if ("${value}_" in values && value in ReservedNames.reserved) {
                    reject("${enum.name()}.$value", "generated code renames it to ${value}_, the name of another value; rename one of them")
                }
            }
        }
    }

    private fun checkType(name: String) {
        val parts = name.split('.')
        for (part in parts) checkWord(name, part)
        val simple = parts.last()
        val namespace = parts.dropLast(1)
        if (simple in ReservedNames.reserved || simple in ReservedNames.types) {
            reject(name, "generated code uses a type of this name; rename the type")
        }
        namespace.find { it in ReservedNames.reserved }?.let { reject(name, "the namespace uses the keyword '$it'; rename the namespace") }
        namespace.find { it in ReservedNames.types }?.let { reject(name, "generated code uses a type named $it; rename the namespace") }
        if (namespace.firstOrNull() in ReservedNames.roots || namespace.joinToString(".") in ReservedNames.packages) {
            reject(
                name,
                "the namespace ${namespace.joinToString(".")} is used by a library or by generated code; rename the namespace",
            )
        }
        if (simple in roots) reject(name, "in generated code it hides the namespace $simple; rename one of them")
        namespace.drop(1).find { it in roots }?.let {
            reject(name, "in C#, the inner namespace $it hides the root namespace $it; rename one of them")
        }
        if (name.length > MAX_NAME) {
            reject(name.take(MAX_NAME), "the name, including its namespace, has more than $MAX_NAME characters; shorten it")
        }
    }

    private fun checkWord(place: String, word: String) {
        if (word.all { it == '_' }) reject(place, "a name must contain a letter; rename it")
        if (word in LITERALS) reject(place, "flatc cannot use the literal '$word' as a name in Java; rename it")
        if (word.length > MAX_WORD) reject(place, "the name has more than $MAX_WORD characters; shorten it")
    }

    /**
     * Rejects names that are too similar. Each type becomes a file, even on case-insensitive file systems, and a constant in upper case.
     */
    private fun checkDistinct(generatedTypes: List<String>) {
        val seen = HashMap<String, String>()
        for (name in objects.map { it.name() } + enums.map { it.name() } + generatedTypes) {
            val other = seen.put(name.replace('.', '_').uppercase(), name) ?: continue
            val place = if (name in generatedTypes) other else name
            reject(place, if (name == other) "$TAKEN; rename the type" else "its name is too similar to that of $other; rename one of them")
        }
        for (name in objects.map { it.name() }) {
            val verifier = seen["${name}Verify".replace('.', '_').uppercase()] ?: continue
            reject(verifier, "code generated for $name has a class of this name; rename one of them")
        }
        val namespaces = seen.values.flatMap { name -> prefixes(name) }.toSet()
        seen.values.find { it in namespaces }?.let { reject(it, "a namespace has the same name; rename one of them") }
    }

    private fun prefixes(name: String): List<String> = name.indices.filter { name[it] == '.' }.map { name.substring(0, it) }

    private fun checkFields(type: BinaryObject) {
        val simple = type.name().substringAfterLast('.')
        val taken = HashMap<String, String>()
        // The builder is a parameter of the methods that create a struct or table.
        for (name in listOf("Builder", "Create$simple", "Start$simple", "End$simple", "GetRootAs$simple")) taken[name] = simple
        val fields = (0 until type.fieldsLength()).map(type::fields)
        for (field in fields) for (name in derived(field)) taken[name] = field.name()
        val seen = HashMap<String, String>()
        for (field in fields.sortedBy(BinaryField::id)) {
            val place = "${type.name()}.${field.name()}"
            val member = upperCamel(field.name())
            checkWord(place, field.name())
            if (member in RESERVED_MEMBERS) reject(place, "C# or Java has a member of this name in every class; rename the field")
            if (member in roots) reject(place, "in C# it hides the namespace $member; rename one of them")
            if (type.isStruct) checkInner(field)
            if (!field.name().first().isLetter()) reject(place, "a name must begin with a letter; rename the field")
            seen.put(member, field.name())?.let {
                reject(place, "this field and $it are both named $member in generated code; rename one of them")
            }
            taken[member]?.let { reject(place, "code generated for $it has a member of this name; rename one of them") }
        }
    }

    /**
     * Rejects a name that C# cannot use in a nested struct. The constructor of a struct has a parameter for each nested number, and C#
     * does not accept a keyword in the middle of the parameter's name.
     */
    private fun checkInner(field: BinaryField) {
        if (field.type().baseType() != BaseType.Obj) return
        val inner = schema.objects(field.type().index())
        for (index in 0 until inner.fieldsLength()) {
            val part = inner.fields(index)
            if (part.type().baseType() != BaseType.Obj || part.name() !in ReservedNames.reserved) continue
            reject("${inner.name()}.${part.name()}", "C# cannot use this name where the struct is nested; rename the field")
        }
    }

    /** Returns the names of the members that flatc generates for a field, besides the accessor itself. */
    private fun derived(field: BinaryField): List<String> {
        val member = upperCamel(field.name())
        val type = field.type().baseType()
        val builder = listOf("Add$member", "Has$member") + if (type in SCALARS) emptyList() else listOf("${member}Offset")
        val bytes = listOf("${member}AsByteBuffer", "${member}InByteBuffer", "Get${member}Bytes", "Get${member}Array")
        val vector =
            listOf(
                "${member}Length",
                "${member}Vector",
                "Create${member}Vector",
                "Create${member}VectorBlock",
                "Start${member}Vector",
            )
        return when (type) {
            BaseType.Vector, BaseType.Vector64 -> builder + bytes + vector
            BaseType.Array -> vector
            BaseType.String -> builder + bytes
            BaseType.Union -> builder + listOf("${member}Type", "${member}AsString")
            else -> builder
        }
    }

    private companion object {
        const val MAX_WORD = 100
        const val MAX_NAME = 200
        const val TAKEN = "the generator uses this name"
        val SCALARS = BaseType.UType..BaseType.Double
        val LITERALS = setOf("true", "false", "null")
        val ENUM_MEMBERS = setOf("names", "value__")

        /** Member names that clash with inherited members or members of flatc's base types. */
        val RESERVED_MEMBERS = setOf(
            "Class", "GetClass", "ToString", "HashCode", "Notify", "NotifyAll", "Wait", "Clone", "Finalize",
            "Equals", "GetHashCode", "GetType", "MemberwiseClone", "ReferenceEquals", "ByteBuffer", "Table",
        )
    }
}
