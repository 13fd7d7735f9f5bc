package org.collektive.lifter

import kotlin.reflect.KCallable
import kotlin.reflect.KClass
import kotlin.reflect.KFunction
import kotlin.reflect.KParameter
import kotlin.reflect.KProperty
import kotlin.reflect.KType
import kotlin.reflect.KTypeParameter
import kotlin.reflect.KTypeProjection
import kotlin.reflect.KVisibility
import kotlin.reflect.full.createType
import kotlin.reflect.full.extensionReceiverParameter
import kotlin.reflect.full.hasAnnotation
import kotlin.reflect.full.valueParameters
import kotlin.reflect.jvm.jvmErasure
import kotlin.reflect.jvm.kotlinFunction

/** A function or property of Kotlin's library with the receiver type [receiver]. A member has the type parameters of its class. */
internal class StdlibFunction private constructor(
    private val callable: KCallable<*>,
    val receiver: KType,
    val typeParameters: List<KTypeParameter>,
    val isMember: Boolean,
) {
    val name: String get() = callable.name
    val parameters: List<KParameter> get() = callable.valueParameters
    val result: KType get() = callable.returnType
    val isProperty: Boolean get() = callable is KProperty<*>

    /** The name with which lifted versions call an extension. With its own name, the compiler would consider all versions for each call. */
    val alias: String? get() = if (isMember) null else "kotlin${name.replaceFirstChar(Char::uppercase)}"

    val isInfix: Boolean get() = callable is KFunction<*> && callable.isInfix

    /** Whether it is an operator. `compareTo` is excluded, because its lifted version returns a field, which `<` does not accept. */
    val isOperator: Boolean get() = callable is KFunction<*> && callable.isOperator && name != "compareTo"

    /**
     * Returns whether this function is lifted: it is pure, public, and declared in Kotlin.
     *
     * Functions of Java's classes are excluded, because they differ between JDKs.
     */
    private fun isLifted(): Boolean = callable.visibility == KVisibility.PUBLIC &&
        name !in NOT_LIFTED &&
        !callable.hasAnnotation<Deprecated>() &&
        result.jvmErasure != Unit::class &&
        (result.jvmErasure !in ARRAYS || receiver.jvmErasure == result.jvmErasure) &&
        (parameters.map { it.type } + result + typeParameters.flatMap { it.upperBounds }).none { EXCLUDED_TYPES.containsMatchIn("$it") }

    companion object {
        /**
         * Functions that Collektive does not lift: members of `Any`; `inc` and `dec`, which assign; `contains`, because `in` requires a
         * Boolean; functions with the names of a field's members; functions that exist on the JVM only; and functions that are newer than
         * the Kotlin version of Collektive 28.3.
         */
        private val NOT_LIFTED = setOf(
            "equals",
            "hashCode",
            "toString",
            "inc",
            "dec",
            "contains",
            "containsValue",
            "getOrDefault",
            "map",
            "fold",
            "foldIndexed",
            "foldRight",
            "foldRightIndexed",
            "reduce",
            "reduceIndexed",
            "reduceIndexedOrNull",
            "reduceOrNull",
            "reduceRight",
            "reduceRightIndexed",
            "reduceRightIndexedOrNull",
            "reduceRightOrNull",
            "binarySearch",
            "copyInto",
            "allDistinct",
            "allDistinctBy",
            "allEqual",
            "allEqualBy",
        )

        /** Matches mutable types, arrays, and Java's types (`!` or their package). */
        private val EXCLUDED_TYPES = Regex("Mutable|Appendable|HashSet|kotlin\\.Array<|!|^java\\.")

        private val ARRAYS = setOf<KClass<*>>(
            BooleanArray::class,
            ByteArray::class,
            CharArray::class,
            DoubleArray::class,
            FloatArray::class,
            IntArray::class,
            LongArray::class,
            ShortArray::class,
        )

        /** Returns the lifted members of [type]. */
        fun members(type: KClass<*>): List<StdlibFunction> {
            val receiver = type.createType(type.typeParameters.map { KTypeProjection.invariant(it.createType()) })
            return type.members.filter { it is KFunction<*> || it is KProperty<*> }
                .map { StdlibFunction(it, receiver, type.typeParameters, isMember = true) }
                .filter { it.isLifted() }
        }

        /** Returns the lifted extensions of [type] in the file [facade] of `kotlin.collections`. */
        fun extensions(facade: String, type: KClass<*>): List<StdlibFunction> = Class.forName("kotlin.collections.$facade").methods
            .filter { it.parameterTypes.firstOrNull() == type.java }
            .mapNotNull { it.kotlinFunction }
            .mapNotNull { function ->
                function.extensionReceiverParameter?.let { StdlibFunction(function, it.type, function.typeParameters, isMember = false) }
            }
            .filter { it.receiver.jvmErasure == type && !it.receiver.toString().contains("Mutable") && it.isLifted() }
    }
}
