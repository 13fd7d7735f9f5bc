package it.unibo.collektive.stdlib

import kotlin.random.Random
import kotlin.reflect.KClass
import kotlin.reflect.KType
import kotlin.reflect.KTypeParameter
import kotlin.reflect.jvm.jvmErasure

/** Creates random values of types in Kotlin's library. Equal seeds give equal values. A type parameter is `Int`, or its bound. */
internal object RandomValues {
    fun of(type: KType, seed: Int): Any? = of(type, Random(seed))

    private fun of(type: KType, random: Random): Any? {
        if (type.isMarkedNullable && random.nextInt(5) == 0) return null
        val given = type.arguments.map { it.type }
        fun argument(index: Int) = of(checkNotNull(given[index]), random)
        fun several(index: Int = 0) = List(random.nextInt(5)) { argument(index) }
        return when (val kind = if (type.classifier is KTypeParameter) bound(type.classifier as KTypeParameter) else type.jvmErasure) {
            Any::class, Comparable::class, Int::class -> random.nextInt(-1, 5)

            Boolean::class -> random.nextBoolean()

            Byte::class -> random.nextInt(-100, 100).toByte()

            Short::class -> random.nextInt(-1000, 1000).toShort()

            Long::class -> random.nextInt(-9, 9) * 10_000_000_000 + random.nextInt(-2, 6)

            Float::class -> random.nextInt(-9, 9) * 0.25f

            Double::class -> random.nextInt(-9, 9) * 0.1

            Char::class -> 'a' + random.nextInt(6)

            UByte::class -> random.nextInt(200).toUByte()

            UShort::class -> random.nextInt(2000).toUShort()

            UInt::class -> random.nextInt(10).toUInt()

            ULong::class -> random.nextInt(10).toULong() * 10_000_000_000u

            String::class, CharSequence::class -> "abcd".take(random.nextInt(5))

            BooleanArray::class -> BooleanArray(random.nextInt(5)) { random.nextBoolean() }

            ByteArray::class -> ByteArray(random.nextInt(5)) { random.nextInt(5).toByte() }

            CharArray::class -> CharArray(random.nextInt(5)) { 'a' + random.nextInt(5) }

            Iterable::class, Collection::class, List::class -> if (given.isEmpty()) {
                List(random.nextInt(5)) {
                    random.nextInt(6)
                }
            } else {
                several()
            }

            Set::class -> several().toSet()

            Sequence::class -> several().asSequence()

            Iterator::class -> several().iterator()

            Map::class -> List(random.nextInt(5)) { random.nextInt(6) }.associateWith { random.nextInt(6) }

            Map.Entry::class -> mapOf(argument(0) to argument(1)).entries.single()

            Pair::class -> argument(0) to argument(1)

            Triple::class -> Triple(argument(0), argument(1), argument(2))

            Result::class -> if (random.nextBoolean()) Result.success(argument(0)) else Result.failure(Failure(random.nextInt(6)))

            IntRange::class -> 0..random.nextInt(3)

            Random::class -> Constant(random.nextInt(100))

            Comparator::class -> if (random.nextBoolean()) {
                compareBy<Comparable<Any>> {
                    it
                }
            } else {
                compareByDescending<Comparable<Any>> { it }
            }

            Unit::class -> Unit

            Function1::class, Function2::class, Function3::class -> Function(checkNotNull(given.last()), random.nextInt())

            else -> error("no values of $kind")
        }
    }

    private fun bound(parameter: KTypeParameter): KClass<*> = parameter.upperBounds.single().jvmErasure

    private data class Failure(val number: Int) : Exception("failure $number")

    /** A generator that always returns the same number, so the order of the calls does not matter. */
    private class Constant(private val number: Int) : Random() {
        override fun nextBits(bitCount: Int) = number and (1 shl bitCount) - 1
    }

    /** A function whose result depends only on its arguments and [seed]. */
    private class Function(private val result: KType, private val seed: Int) :
        (Any?) -> Any?,
        (Any?, Any?) -> Any?,
        (Any?, Any?, Any?) -> Any? {
        override fun invoke(p1: Any?) = of(result, 31 * seed + p1.hashCode())

        override fun invoke(p1: Any?, p2: Any?) = of(result, 31 * (31 * seed + p1.hashCode()) + p2.hashCode())

        override fun invoke(p1: Any?, p2: Any?, p3: Any?) = invoke(p1 to p2, p3)
    }
}
