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

/** A function or property of Kotlin's library, with [receiver] before its dot. A member has the type parameters of its class. */
internal class Plain private constructor(
    private val callable: KCallable<*>,
    val receiver: KType,
    val typeParameters: List<KTypeParameter>,
    val isMember: Boolean,
) {
    val name: String get() = callable.name
    val parameters: List<KParameter> get() = callable.valueParameters
    val result: KType get() = callable.returnType
    val isProperty: Boolean get() = callable is KProperty<*>
    val isInfix: Boolean get() = callable is KFunction<*> && callable.isInfix

    /** A lifted `compareTo` returns a field, so that `<` cannot use it. */
    val isOperator: Boolean get() = callable is KFunction<*> && callable.isOperator && name != "compareTo"

    /**
     * Whether fields have it: a function of values that Kotlin's sources declare.
     *
     * What comes from Java's classes differs from one JDK to the next.
     */
    private fun isLifted(): Boolean = callable.visibility == KVisibility.PUBLIC &&
        name !in NOT_LIFTED &&
        !callable.hasAnnotation<Deprecated>() &&
        result.jvmErasure != Unit::class &&
        (result.jvmErasure !in ARRAYS || receiver.jvmErasure == result.jvmErasure) &&
        (parameters.map { it.type } + result + typeParameters.flatMap { it.upperBounds }).none { UNWANTED.containsMatchIn("$it") }

    companion object {
        /**
         * What Collektive does not lift: functions of every object, `inc` and `dec`, which assign; the Boolean that `in` needs; names that
         * fields themselves have; what only the JVM has; and what is newer than Collektive 28.3's Kotlin.
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

        /** Types of what changes, of arrays but for the receiver's own, and, by `!` and their package, of Java's. */
        private val UNWANTED = Regex("Mutable|Appendable|HashSet|kotlin\\.Array<|!|^java\\.")

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

        /** The members of [type]. */
        fun members(type: KClass<*>): List<Plain> {
            val receiver = type.createType(type.typeParameters.map { KTypeProjection.invariant(it.createType()) })
            return type.members.filter { it is KFunction<*> || it is KProperty<*> }
                .map { Plain(it, receiver, type.typeParameters, isMember = true) }
                .filter { it.isLifted() }
        }

        /** The extensions of [type] in the file [facade] of `kotlin.collections`. */
        fun extensions(facade: String, type: KClass<*>): List<Plain> = Class.forName("kotlin.collections.$facade").methods
            .filter { it.parameterTypes.firstOrNull() == type.java }
            .mapNotNull { it.kotlinFunction }
            .mapNotNull { function ->
                function.extensionReceiverParameter?.let { Plain(function, it.type, function.typeParameters, isMember = false) }
            }
            .filter { it.receiver.jvmErasure == type && !it.receiver.toString().contains("Mutable") && it.isLifted() }
    }
}
