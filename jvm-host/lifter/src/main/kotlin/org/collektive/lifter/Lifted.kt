package org.collektive.lifter

import kotlin.reflect.KType
import kotlin.reflect.KTypeParameter
import kotlin.reflect.KVariance
import kotlin.reflect.jvm.jvmErasure

/** [plain] with fields at the places [fields]: 0 is the receiver, 1 the first parameter. */
internal class Lifted private constructor(private val plain: Plain, private val fields: List<Int>) {
    private val types = listOf(plain.receiver) + plain.parameters.map { it.type }
    private val names = listOf("this") + plain.parameters.map { it.name }

    /** Two functions of an object with the same of this need two names on the JVM. */
    val erased: String = plain.name + types.indices.map { if (it in fields) "Field" else types[it].jvmErasure.qualifiedName }

    /** The function's source. With [isNamed] its name on the JVM tells its types. */
    fun source(isNamed: Boolean): String {
        val typeParameters = plain.typeParameters.map(::declaration)
        val id = "ID : Any"
        val generics = if (plain.isMember && 0 in fields) listOf(id) + typeParameters else typeParameters + id
        val parameters = types.indices.drop(1).joinToString { "${names[it]}: ${type(it)}" }
        val modifiers =
            listOf("public", "inline".takeIf { hasReified() }, "operator".takeIf { plain.isOperator }, "infix".takeIf { plain.isInfix })
        val head = (modifiers.filterNotNull() + "fun").joinToString(" ")
        val jvmName = if (isNamed) "@JvmName(\"${plain.name}${types.indices.joinToString("", transform = ::letters)}\")\n" else ""
        val resolved = if (isNamed && takesFunction()) RESOLVED_BY_LAMBDA else ""
        return "$jvmName$resolved$head ${generics.joinToString(prefix = "<", postfix = ">")} ${type(0)}.${plain.name}($parameters): " +
            "Field<ID, ${plain.result.source()}> =\n    ${body()}"
    }

    private fun type(place: Int) = types[place].source().let { if (place in fields) "Field<ID, $it>" else it }

    private fun letters(place: Int) = type(place).replace("ID", "").filter(Char::isLetterOrDigit)

    private fun takesFunction() = types.indices.any { it !in fields && "Function" in type(it) }

    private fun hasReified() = plain.typeParameters.any { it.isReified }

    private fun body(): String {
        val values = if (fields.size == 1) listOf("it") else fields.indices.map { "v$it" }
        val arguments = names.indices.map { place -> if (place in fields) values[fields.indexOf(place)] else names[place] }
        val reified = if (hasReified()) plain.typeParameters.joinToString(prefix = "<", postfix = ">") { it.name } else ""
        val call =
            "${arguments[0]}.${plain.name}$reified" +
                if (plain.isProperty) "" else arguments.drop(1).joinToString(prefix = "(", postfix = ")")
        val first = names[fields.first()]
        if (fields.size == 1) return "$first.mapValues { $call }"
        return "$first.alignedMapValues(${fields.drop(1).joinToString { "${names[it]}" }}) { ${values.joinToString()} -> $call }"
    }

    private fun declaration(parameter: KTypeParameter): String {
        val bounds = parameter.upperBounds.map { it.source() }.filter { it != "Any?" }
        val reified = if (parameter.isReified) "reified " else ""
        return reified + parameter.name + if (bounds.isEmpty()) "" else " : ${bounds.single()}"
    }

    companion object {
        /** All ways to lift [plain]: each non-empty set of places. A field is itself a value of type `Any?`, so that is no place for one. */
        fun of(plain: Plain): List<Lifted> {
            val places = listOf(0) + plain.parameters.indices.map { it + 1 }.filter { plain.parameters[it - 1].type.source() != "Any?" }
            return (1 until (1 shl places.size)).map { set -> Lifted(plain, places.filterIndexed { index, _ -> set shr index and 1 == 1 }) }
                .filter { 0 in it.fields || plain.parameters.size + 1 == places.size }
        }

        /** As Kotlin's own overloads have it: the result of a lambda chooses between `Iterable` and `Sequence`. */
        private const val RESOLVED_BY_LAMBDA = "@OverloadResolutionByLambdaReturnType\n"

        private val IMPORTED = Regex("^kotlin\\.(collections\\.|ranges\\.|sequences\\.)?(?=[A-Z])")

        private fun KType.source(): String {
            val name = when (val found = classifier) {
                is KTypeParameter -> found.name
                else -> checkNotNull(jvmErasure.qualifiedName).replace(IMPORTED, "")
            }
            val given = arguments.map { (variance, type) ->
                when (variance) {
                    null -> "*"

                    KVariance.INVARIANT -> checkNotNull(type).source()

                    KVariance.OUT -> "out ${checkNotNull(type).source()}"

                    // Collektive takes `Comparator<Byte>` where Kotlin takes `Comparator<in Byte>`.
                    KVariance.IN -> (if (checkNotNull(type).classifier is KTypeParameter) "in " else "") + type.source()
                }
            }
            return name + (if (given.isEmpty()) "" else given.joinToString(prefix = "<", postfix = ">")) + if (isMarkedNullable) "?" else ""
        }
    }
}
