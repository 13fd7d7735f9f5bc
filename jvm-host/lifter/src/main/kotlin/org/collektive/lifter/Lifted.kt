package org.collektive.lifter

import com.squareup.kotlinpoet.AnnotationSpec
import com.squareup.kotlinpoet.ClassName
import com.squareup.kotlinpoet.FunSpec
import com.squareup.kotlinpoet.KModifier
import com.squareup.kotlinpoet.ParameterizedTypeName
import com.squareup.kotlinpoet.ParameterizedTypeName.Companion.parameterizedBy
import com.squareup.kotlinpoet.STAR
import com.squareup.kotlinpoet.TypeName
import com.squareup.kotlinpoet.TypeVariableName
import com.squareup.kotlinpoet.WildcardTypeName
import com.squareup.kotlinpoet.WildcardTypeName.Companion.consumerOf
import com.squareup.kotlinpoet.WildcardTypeName.Companion.producerOf
import com.squareup.kotlinpoet.asTypeName
import kotlin.experimental.ExperimentalTypeInference
import kotlin.reflect.KType
import kotlin.reflect.jvm.jvmErasure
import kotlin.reflect.typeOf

/** [plain] with fields at the places [fields]: 0 is the receiver, 1 the first parameter. */
internal class Lifted private constructor(private val plain: Plain, private val fields: List<Int>) {
    private val given = listOf(plain.receiver) + plain.parameters.map { it.type }
    private val types = given.mapIndexed { place, type -> if (place in fields) fieldOf(type) else typeName(type) }
    private val names = listOf("this") + plain.parameters.map { checkNotNull(it.name) }
    private val isReified = plain.typeParameters.any { it.isReified }

    /** Two functions of an object with the same signature on the JVM need two names there. */
    val erased: String = plain.name + given.indices.map { if (it in fields) "Field" else given[it].jvmErasure.qualifiedName }

    /** The function. With [isNamed] its name on the JVM contains its types. */
    @OptIn(ExperimentalTypeInference::class)
    fun function(isNamed: Boolean): FunSpec {
        val typeParameters = plain.typeParameters.map {
            TypeVariableName(it.name, it.upperBounds.map(::typeName)).copy(reified = it.isReified)
        }
        return FunSpec.builder(plain.name).apply {
            if (isNamed) {
                val name = plain.name + types.joinToString("", transform = ::letters)
                addAnnotation(AnnotationSpec.builder(JvmName::class).addMember("%S", name).build())
            }
            // Like Kotlin's own overloads: the result of a lambda chooses between `Iterable` and `Sequence`.
            if (isNamed && takesFunction()) addAnnotation(OverloadResolutionByLambdaReturnType::class)
            if (isReified) addModifiers(KModifier.INLINE)
            if (plain.isOperator) addModifiers(KModifier.OPERATOR)
            if (plain.isInfix) addModifiers(KModifier.INFIX)
            addTypeVariables(if (plain.isMember && 0 in fields) listOf(ID) + typeParameters else typeParameters + ID)
            receiver(types.first())
            for (place in 1 until types.size) addParameter(names[place], types[place])
            returns(fieldOf(plain.result))
            addStatement("return·%L", body())
        }.build()
    }

    private fun takesFunction() = given.indices.any { it !in fields && given[it].jvmErasure.java.packageName == "kotlin.jvm.functions" }

    private fun body(): String {
        val values = if (fields.size == 1) listOf("it") else fields.indices.map { "v$it" }
        val arguments = names.indices.map { place -> if (place in fields) values[fields.indexOf(place)] else names[place] }
        val reified = if (isReified) plain.typeParameters.joinToString(prefix = "<", postfix = ">") { it.name } else ""
        val call =
            "${arguments[0]}.${plain.name}$reified" +
                if (plain.isProperty) "" else arguments.drop(1).joinToString(prefix = "(", postfix = ")")
        val first = names[fields.first()]
        if (fields.size == 1) return "$first.mapValues { $call }"
        return "$first.alignedMapValues(${fields.drop(1).joinToString { names[it] }}) { ${values.joinToString()} -> $call }"
    }

    companion object {
        private val FIELD = ClassName("it.unibo.collektive.aggregate", "Field")
        private val ID = TypeVariableName("ID", Any::class)

        /** All ways to lift [plain]: each non-empty set of places. A field is itself a value of type `Any?`, which is thus not a place. */
        fun of(plain: Plain): List<Lifted> {
            val places = listOf(0) + plain.parameters.indices.map { it + 1 }.filter { plain.parameters[it - 1].type != typeOf<Any?>() }
            return (1 until (1 shl places.size)).map { set -> Lifted(plain, places.filterIndexed { index, _ -> set shr index and 1 == 1 }) }
                .filter { 0 in it.fields || plain.parameters.size + 1 == places.size }
        }

        private fun fieldOf(type: KType) = FIELD.parameterizedBy(ID, typeName(type))

        private fun typeName(type: KType) = adapted(type.asTypeName())

        /** [type] without annotations, and like Collektive with `Comparator<Byte>` where Kotlin has `Comparator<in Byte>`. */
        private fun adapted(type: TypeName): TypeName = when (type) {
            is ParameterizedTypeName -> type.copy(annotations = emptyList(), typeArguments = type.typeArguments.map(::adapted))

            is WildcardTypeName -> {
                val bound = adapted(type.inTypes.singleOrNull() ?: type.outTypes.single())
                if (type.inTypes.isEmpty()) producerOf(bound) else bound as? ClassName ?: consumerOf(bound)
            }

            else -> type.copy(annotations = emptyList())
        }

        private fun letters(type: TypeName): String = when (type) {
            STAR, ID -> ""
            is ClassName -> type.simpleNames.joinToString("")
            is ParameterizedTypeName -> letters(type.rawType) + type.typeArguments.joinToString("", transform = ::letters)
            is WildcardTypeName -> type.inTypes.singleOrNull()?.let { "in" + letters(it) } ?: ("out" + letters(type.outTypes.single()))
            else -> "$type".removeSuffix("?")
        }
    }
}
