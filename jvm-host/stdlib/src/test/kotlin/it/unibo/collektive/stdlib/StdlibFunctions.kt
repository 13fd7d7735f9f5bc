package it.unibo.collektive.stdlib

import it.unibo.collektive.aggregate.Field
import java.lang.reflect.InvocationTargetException
import java.lang.reflect.Method
import kotlin.reflect.KCallable
import kotlin.reflect.KClass
import kotlin.reflect.KFunction
import kotlin.reflect.KType
import kotlin.reflect.full.extensionReceiverParameter
import kotlin.reflect.full.hasAnnotation
import kotlin.reflect.full.instanceParameter
import kotlin.reflect.jvm.isAccessible
import kotlin.reflect.jvm.jvmErasure
import kotlin.reflect.jvm.kotlinFunction

/** Finds Kotlin's own functions for the functions of [lifted], an object that contains lifted operators. */
internal class StdlibFunctions(private val lifted: KClass<*>) {
    private val functions = HashMap<Method, KFunction<*>?>()
    private val candidates = HashMap<Pair<KClass<*>, String>, List<Pair<KCallable<*>, List<String>>>>()

    /** Returns a function that computes the expected result of [function] for one entry from the entry's receiver and arguments. */
    fun of(function: KFunction<*>): (List<Any?>) -> Any? {
        val types = types(function)
        val receiver = types.first().jvmErasure
        val named = candidates.getOrPut(receiver to function.name) {
            val all = if (isOfExtensions) extensions(receiver, function.name) else receiver.members
            all.filter { it.name == function.name && !it.hasAnnotation<Deprecated>() }.map { it to types(it).map(::text) }
        }
        val texts = types.map(::text)
        val plain = checkNotNull(named.singleOrNull { it.second == texts }) { "for $function: $named" }.first
        if (!isOfExtensions && (receiver in BUILT_IN || receiver in TEXTS && (plain.name == "get" || plain.name == "plus"))) {
            return { builtIn(plain.name, it) }
        }
        plain.isAccessible = true
        return {
            try {
                plain.call(*it.toTypedArray())
            } catch (e: InvocationTargetException) {
                throw e.targetException
            }
        }
    }

    private val isOfExtensions get() = lifted.simpleName.orEmpty().endsWith("Extensions")

    /**
     * Returns the extensions of [receiver] whose name on the JVM begins with [name]. The search is limited to these because resolving all
     * Kotlin functions would take a minute.
     */
    private fun extensions(receiver: KClass<*>, name: String): List<KCallable<*>> {
        val file = lifted.simpleName.orEmpty().removePrefix("Fielded").removeSuffix("Extensions")
        return Class.forName("kotlin.collections.${file}Kt").methods
            .filter { it.name.startsWith(name) && it.parameterTypes.firstOrNull() == receiver.java }
            .mapNotNull { method -> functions.getOrPut(method) { method.kotlinFunction } }
    }

    /** Returns the types of the receiver and the parameters. Instead of the type of a field, returns the type of its values. */
    private fun types(callable: KCallable<*>): List<KType> = callable.parameters
        .filter { it != callable.instanceParameter || callable.extensionReceiverParameter == null }
        .map { if (it.type.classifier == Field::class) checkNotNull(it.type.arguments[1].type) else it.type }

    private fun text(type: KType) =
        "$type".substringAfter("/* = ").substringBefore(" */").replace("Comparator<in ", "Comparator<").replace(OF_MEMBER, "$1")

    /** Computes the result of a function that is built into the compiler, because reflection cannot call it. */
    private fun builtIn(name: String, values: List<Any?>): Any? {
        val a = values[0]
        val b = values.getOrNull(1)
        return when {
            a is Boolean -> ofBooleans(name, a, b as? Boolean)
            a is Char -> ofChars(name, a, b)
            a is String -> if (name == "get") a[b as Int] else a + b
            name.startsWith("to") -> converted(name, a as Number)
            b == null -> ofNumbers(name, a as Number, if (name == "inv") -1 else 0)
            else -> ofNumbers(name, a as Number, b as Number)
        }
    }

    private fun ofBooleans(name: String, a: Boolean, b: Boolean?): Any = when (name) {
        "and" -> a && b == true
        "or" -> a || b == true
        "xor" -> a != b
        "not" -> !a
        "compareTo" -> a.compareTo(b == true)
        else -> error(name)
    }

    private fun ofChars(name: String, a: Char, b: Any?): Any = when (name) {
        "plus" -> Char(a.code + b as Int)
        "minus" -> if (b is Char) a.code - b.code else Char(a.code - b as Int)
        "compareTo" -> a.compareTo(b as Char)
        "rangeTo" -> a..b as Char
        "rangeUntil" -> a..<b as Char
        "toChar" -> a
        else -> error(name)
    }

    private fun converted(name: String, a: Number): Any = when (name) {
        "toByte" -> a.toByte()
        "toShort" -> a.toShort()
        "toInt" -> a.toInt()
        "toLong" -> a.toLong()
        "toFloat" -> a.toFloat()
        "toDouble" -> a.toDouble()
        "toChar" -> Char(a.toInt().toUShort())
        else -> error(name)
    }

    /** Computes an operator of two numbers in the wider of their types, but at least in Int, as Kotlin does. Shift counts are Int. */
    private fun ofNumbers(name: String, a: Number, b: Number): Any = when {
        name == "shl" || name == "shr" || name == "ushr" -> shifted(name, a, b.toInt())
        a is Double || b is Double -> ofDoubles(name, a.toDouble(), b.toDouble())
        a is Float || b is Float -> ofFloats(name, a.toFloat(), b.toFloat())
        a is Long || b is Long -> ofLongs(name, a.toLong(), b.toLong())
        else -> ofInts(name, a.toInt(), b.toInt())
    }

    private fun shifted(name: String, a: Number, bits: Int): Any = when (name) {
        "shl" -> if (a is Long) a shl bits else a.toInt() shl bits
        "shr" -> if (a is Long) a shr bits else a.toInt() shr bits
        else -> if (a is Long) a ushr bits else a.toInt() ushr bits
    }

    private fun ofInts(name: String, a: Int, b: Int): Any = when (name) {
        "plus" -> a + b
        "minus" -> a - b
        "times" -> a * b
        "div" -> a / b
        "rem" -> a % b
        "compareTo" -> a.compareTo(b)
        "rangeTo" -> a..b
        "rangeUntil" -> a..<b
        "and" -> a and b
        "or" -> a or b
        "xor", "inv" -> a xor b
        "unaryPlus" -> a
        "unaryMinus" -> -a
        else -> error(name)
    }

    private fun ofLongs(name: String, a: Long, b: Long): Any = when (name) {
        "plus" -> a + b
        "minus" -> a - b
        "times" -> a * b
        "div" -> a / b
        "rem" -> a % b
        "compareTo" -> a.compareTo(b)
        "rangeTo" -> a..b
        "rangeUntil" -> a..<b
        "and" -> a and b
        "or" -> a or b
        "xor", "inv" -> a xor b
        "unaryPlus" -> a
        "unaryMinus" -> -a
        else -> error(name)
    }

    private fun ofFloats(name: String, a: Float, b: Float): Any = when (name) {
        "plus" -> a + b
        "minus" -> a - b
        "times" -> a * b
        "div" -> a / b
        "rem" -> a % b
        "compareTo" -> a.compareTo(b)
        "unaryPlus" -> a
        "unaryMinus" -> -a
        else -> error(name)
    }

    private fun ofDoubles(name: String, a: Double, b: Double): Any = when (name) {
        "plus" -> a + b
        "minus" -> a - b
        "times" -> a * b
        "div" -> a / b
        "rem" -> a % b
        "compareTo" -> a.compareTo(b)
        "unaryPlus" -> a
        "unaryMinus" -> -a
        else -> error(name)
    }

    private companion object {
        val BUILT_IN = setOf<KClass<*>>(
            Boolean::class,
            Byte::class,
            Char::class,
            Double::class,
            Float::class,
            Int::class,
            Long::class,
            Short::class,
        )

        val TEXTS = setOf<KClass<*>>(CharSequence::class, String::class)

        /** A type parameter of a class, as reflection prints it. */
        val OF_MEMBER = Regex("@kotlin\\.UnsafeVariance (\\w+)")
    }
}
