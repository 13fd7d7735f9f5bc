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

/** A version of [function] that accepts fields at the positions [fields]: 0 is the receiver, 1 the first parameter. */
internal class LiftedFunction private constructor(private val function: StdlibFunction, private val fields: List<Int>) {
    private val parameterTypes = listOf(function.receiver) + function.parameters.map { it.type }
    private val types = parameterTypes.mapIndexed { place, type -> if (place in fields) fieldOf(type) else typeName(type) }
    private val names = listOf("this") + function.parameters.map { checkNotNull(it.name) }
    private val isReified = function.typeParameters.any { it.isReified }

    /** The signature on the JVM. Functions of one object with equal signatures need different JVM names. */
    val jvmSignature: String =
        function.name + parameterTypes.indices.map { if (it in fields) "Field" else parameterTypes[it].jvmErasure.qualifiedName }

    /** Builds the function. With [isNamed], its JVM name contains its parameter types. */
    @OptIn(ExperimentalTypeInference::class)
    fun toFunSpec(isNamed: Boolean): FunSpec {
        val typeParameters = function.typeParameters.map {
            TypeVariableName(it.name, it.upperBounds.map(::typeName)).copy(reified = it.isReified)
        }
        return FunSpec.builder(function.name).apply {
            if (isNamed) {
                val name = function.name + types.joinToString("", transform = ::nameOf)
                addAnnotation(AnnotationSpec.builder(JvmName::class).addMember("%S", name).build())
            }
            // As in Kotlin's library, the result of a lambda selects the overload for `Iterable` or `Sequence`.
            if (isNamed && takesFunction()) addAnnotation(OverloadResolutionByLambdaReturnType::class)
            if (isReified) addModifiers(KModifier.INLINE)
            if (function.isOperator) addModifiers(KModifier.OPERATOR)
            if (function.isInfix) addModifiers(KModifier.INFIX)
            addTypeVariables(if (function.isMember && 0 in fields) listOf(ID) + typeParameters else typeParameters + ID)
            receiver(types.first())
            for (place in 1 until types.size) addParameter(names[place], types[place])
            returns(fieldOf(function.result))
            addStatement("return·%L", body())
        }.build()
    }

    private fun takesFunction() =
        parameterTypes.indices.any { it !in fields && parameterTypes[it].jvmErasure.java.packageName == "kotlin.jvm.functions" }

    private fun body(): String {
        val values = if (fields.size == 1) listOf("it") else fields.indices.map { "v$it" }
        val arguments = names.indices.map { place -> if (place in fields) values[fields.indexOf(place)] else names[place] }
        val reified = if (isReified) function.typeParameters.joinToString(prefix = "<", postfix = ">") { it.name } else ""
        val call =
            "${arguments[0]}.${function.alias ?: function.name}$reified" +
                if (function.isProperty) "" else arguments.drop(1).joinToString(prefix = "(", postfix = ")")
        val first = names[fields.first()]
        if (fields.size == 1) return "$first.mapValues { $call }"
        return "$first.alignedMapValues(${fields.drop(1).joinToString { names[it] }}) { ${values.joinToString()} -> $call }"
    }

    companion object {
        private val FIELD = ClassName("it.unibo.collektive.aggregate", "Field")
        private val ID = TypeVariableName("ID", Any::class)

        /** Returns all lifted versions of [function]: one per non-empty set of positions. Parameters of type `Any?` accept fields. */
        fun of(function: StdlibFunction): List<LiftedFunction> {
            val places =
                listOf(0) + function.parameters.indices.map { it + 1 }.filter { function.parameters[it - 1].type != typeOf<Any?>() }
            return (1 until (1 shl places.size))
                .map { set -> LiftedFunction(function, places.filterIndexed { index, _ -> set shr index and 1 == 1 }) }
                .filter { 0 in it.fields || function.parameters.size + 1 == places.size }
        }

        private fun fieldOf(type: KType) = FIELD.parameterizedBy(ID, typeName(type))

        private fun typeName(type: KType) = normalized(type.asTypeName())

        /** Returns [type] without annotations. As in Collektive, `Comparator<in Byte>` becomes `Comparator<Byte>`. */
        private fun normalized(type: TypeName): TypeName = when (type) {
            is ParameterizedTypeName -> type.copy(annotations = emptyList(), typeArguments = type.typeArguments.map(::normalized))

            is WildcardTypeName -> {
                val bound = normalized(type.inTypes.singleOrNull() ?: type.outTypes.single())
                if (type.inTypes.isEmpty()) producerOf(bound) else bound as? ClassName ?: consumerOf(bound)
            }

            else -> type.copy(annotations = emptyList())
        }

        private fun nameOf(type: TypeName): String = when (type) {
            STAR, ID -> ""
            is ClassName -> type.simpleNames.joinToString("")
            is ParameterizedTypeName -> nameOf(type.rawType) + type.typeArguments.joinToString("", transform = ::nameOf)
            is WildcardTypeName -> type.inTypes.singleOrNull()?.let { "in" + nameOf(it) } ?: ("out" + nameOf(type.outTypes.single()))
            else -> "$type".removeSuffix("?")
        }
    }
}
