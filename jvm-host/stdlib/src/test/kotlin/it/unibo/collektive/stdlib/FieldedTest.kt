package it.unibo.collektive.stdlib

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.mapNeighborhood
import it.unibo.collektive.aggregate.toMap
import it.unibo.collektive.stdlib.booleans.FieldedBooleans
import it.unibo.collektive.stdlib.doubles.FieldedDoubles
import it.unibo.collektive.stdlib.floats.FieldedFloats
import it.unibo.collektive.stdlib.ints.FieldedInts
import it.unibo.collektive.stdlib.ints.FieldedInts.plus
import it.unibo.collektive.stdlib.longs.FieldedLongs
import org.junit.jupiter.api.Test
import java.lang.reflect.Method
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

/** Calls every lifted operator on random fields, and compares each entry with the plain operator. */
class FieldedTest {
    private val random = Random(3)
    private val types = listOf("Int", "Long", "Float", "Double")

    private fun number(type: String): Number {
        val value = random.nextInt(1, 100) * if (random.nextBoolean()) 1 else -1
        return when (type) {
            "Int" -> value
            "Long" -> value * 10_000_000_000
            "Float" -> value * 0.25f
            else -> value * 0.1
        }
    }

    private fun binary(name: String, a: Number, b: Number): Any {
        val widest = types.last { it == a::class.simpleName || it == b::class.simpleName }
        return when (widest) {
            "Int" -> arithmetic(name, a.toInt(), b.toInt(), Int::plus, Int::minus, Int::times, Int::div, Int::rem)
            "Long" -> arithmetic(name, a.toLong(), b.toLong(), Long::plus, Long::minus, Long::times, Long::div, Long::rem)
            "Float" -> arithmetic(name, a.toFloat(), b.toFloat(), Float::plus, Float::minus, Float::times, Float::div, Float::rem)
            else -> arithmetic(name, a.toDouble(), b.toDouble(), Double::plus, Double::minus, Double::times, Double::div, Double::rem)
        }
    }

    private fun <T : Comparable<T>> arithmetic(
        name: String,
        a: T,
        b: T,
        plus: (T, T) -> T,
        minus: (T, T) -> T,
        times: (T, T) -> T,
        div: (T, T) -> T,
        rem: (T, T) -> T,
    ): Any = when (name) {
        "plus" -> plus(a, b)
        "minus" -> minus(a, b)
        "times" -> times(a, b)
        "div" -> div(a, b)
        "rem" -> rem(a, b)
        "compareTo" -> a.compareTo(b)
        "and", "or", "xor" -> bits(name, a, b)
        else -> error("unknown operator $name")
    }

    private fun bits(name: String, a: Any, b: Any): Any = when {
        a is Int && b is Int -> when (name) {
            "and" -> a and b
            "or" -> a or b
            else -> a xor b
        }

        a is Long && b is Long -> when (name) {
            "and" -> a and b
            "or" -> a or b
            else -> a xor b
        }

        else -> error("no bits in $a, $b")
    }

    private fun unary(name: String, a: Number): Any = when (name) {
        "unaryPlus" -> a

        "unaryMinus" -> binary("times", a, -1)

        "inc" -> binary("plus", a, 1)

        "dec" -> binary("minus", a, 1)

        "inv" -> if (a is Int) a.inv() else a.toLong().inv()

        "toByte" -> a.toByte()

        "toShort" -> a.toShort()

        "toInt" -> if (a is Double) {
            a.toInt()
        } else if (a is Float) {
            a.toInt()
        } else {
            a.toInt()
        }

        "toLong" -> if (a is Double) {
            a.toLong()
        } else if (a is Float) {
            a.toLong()
        } else {
            a.toLong()
        }

        "toFloat" -> a.toFloat()

        "toDouble" -> a.toDouble()

        else -> error("unknown operator $name")
    }

    private fun shift(name: String, a: Number, bits: Int): Any = when {
        a is Int -> when (name) {
            "shl" -> a shl bits
            "shr" -> a shr bits
            else -> a ushr bits
        }

        else -> a.toLong().let {
            when (name) {
                "shl" -> it shl bits
                "shr" -> it shr bits
                else -> it ushr bits
            }
        }
    }

    private fun Method.typeNamed(index: Int, receiver: String): String = when {
        parameterTypes[index] != Field::class.java -> parameterTypes[index].simpleName.replaceFirstChar(Char::uppercase)
        "Field" in name -> if (index == 0) receiver else name.substringAfterLast("Field")
        else -> receiver
    }

    @Test
    fun `every operator on numbers applies the plain one to each entry`() {
        val objects = mapOf("Int" to FieldedInts, "Long" to FieldedLongs, "Float" to FieldedFloats, "Double" to FieldedDoubles)
        val swarm = Swarm(3).line(1.0, 1.0)
        swarm.round { mapNeighborhood { it } }
        var called = 0
        for ((receiver, lifted) in objects) {
            for (method in lifted.javaClass.declaredMethods.filter {
                java.lang.reflect.Modifier.isPublic(it.modifiers) && !it.isSynthetic
            }) {
                val operator = method.name.substringBefore("Field").removePrefix(receiver.lowercase()).replaceFirstChar(Char::lowercase)
                swarm.round {
                    if (localId != 1) return@round mapNeighborhood { it }.let { }
                    val shape = mapNeighborhood { it }
                    val kinds = method.parameterTypes.indices.map { method.typeNamed(it, receiver) }
                    val isShift = operator in setOf("shl", "shr", "ushr")
                    val arguments = kinds.mapIndexed { index, kind ->
                        if (method.parameterTypes[index] ==
                            Field::class.java
                        ) {
                            shape.mapValues { number(kind) }
                        } else if (isShift) {
                            5
                        } else {
                            number(kind)
                        }
                    }
                    fun at(index: Int, id: Int) =
                        arguments[index].let { if (it is Field<*, *>) (it.all.list.first { e -> e.id == id }.value) else it } as Number
                    val result = method.invoke(lifted, *arguments.toTypedArray()) as Field<*, *>
                    for (entry in result.all.list) {
                        val id = entry.id as Int
                        val expected = when {
                            arguments.size == 1 -> unary(operator, at(0, id))
                            isShift -> shift(operator, at(0, id), at(1, id).toInt())
                            else -> binary(operator, at(0, id), at(1, id))
                        }
                        assertEquals(expected, entry.value, "${method.name} of ${arguments.map { it.toString() }}")
                    }
                    called++
                }
            }
        }
        assertTrue(called > 250, "only $called operators")
    }

    @Test
    fun `every operator on truth values applies the plain one to each entry`() {
        val swarm = Swarm(4)
        for (id in 0..2) swarm.link(id, 3)
        swarm.round { mapNeighborhood { it } }
        swarm.round {
            val shape = mapNeighborhood { it }
            if (localId != 3) return@round
            val a = shape.mapValues { it and 1 == 1 }
            val b = shape.mapValues { it and 2 == 2 }
            fun expect(field: Field<Int, Any>, plain: (Boolean, Boolean) -> Any) =
                assertEquals((0..3).associateWith { plain(it and 1 == 1, it and 2 == 2) }, field.all.toMap())
            with(FieldedBooleans) {
                expect(a and b) { x, y -> x && y }
                expect(a or b) { x, y -> x || y }
                expect(a xor b) { x, y -> x != y }
                expect(a and true) { x, _ -> x }
                expect(a or false) { x, _ -> x }
                expect(a xor true) { x, _ -> !x }
                expect(!a) { x, _ -> !x }
                expect(a.compareTo(b)) { x, y -> x.compareTo(y) }
                expect(a.compareTo(true)) { x, _ -> x.compareTo(true) }
            }
        }
    }

    @Test
    fun `fields of different devices cannot be combined`() {
        val swarm = Swarm(2).line(1.0)
        assertFailsWith<IllegalStateException> {
            swarm.rounds(2) {
                val narrow = alignedOn(localId) { listOf(mapNeighborhood { it }) }.first()
                (mapNeighborhood { it } + narrow).local
            }
        }
    }
}
