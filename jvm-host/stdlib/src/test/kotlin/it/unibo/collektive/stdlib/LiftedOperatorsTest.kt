package it.unibo.collektive.stdlib

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.mapNeighborhood
import it.unibo.collektive.aggregate.toMap
import it.unibo.collektive.stdlib.ints.FieldedInts
import it.unibo.collektive.stdlib.ints.FieldedInts.plus
import it.unibo.collektive.stdlib.iterables.FieldedCollectionsExtensions.filterIsInstance
import it.unibo.collektive.stdlib.iterables.FieldedCollectionsExtensions.flatMap
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import java.io.File
import java.lang.reflect.InvocationTargetException
import java.util.jar.JarFile
import kotlin.reflect.KFunction
import kotlin.reflect.full.declaredMemberExtensionFunctions
import kotlin.reflect.full.extensionReceiverParameter
import kotlin.reflect.full.valueParameters
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue
import kotlin.test.fail

/** Calls every lifted operator on random fields, and compares each entry with the result of Kotlin's own function. */
class LiftedOperatorsTest {
    @Tag("repeats")
    @TestFactory
    fun `every function applies Kotlin's function to each entry`() = objects().map { name ->
        val lifted = Class.forName(name).kotlin
        dynamicTest(name.removePrefix("it.unibo.collektive.stdlib.")) {
            val plain = StdlibFunctions(lifted)
            inRound { shape ->
                for (function in lifted.declaredMemberExtensionFunctions) {
                    if (function.typeParameters.any { it.isReified }) continue
                    compare(checkNotNull(lifted.objectInstance), function, plain.of(function), shape)
                }
            }
        }
    }

    /** Compares [function] on all kinds of values, until it has succeeded three times. */
    private fun compare(lifted: Any, function: KFunction<*>, plain: (List<Any?>) -> Any?, shape: Field<Int, Int>) {
        val types = (listOf(checkNotNull(function.extensionReceiverParameter)) + function.valueParameters).map { it.type }
        val isUnordered = function.name == "shuffled" && types.size == 1
        fun result(value: Any?) = if (isUnordered) (value as List<*>).groupBy { it } else shown(value)
        var succeeded = 0
        for (trial in 0 until 20_000) {
            fun value(place: Int, id: Int): Any? {
                val type = types[place]
                return if (type.classifier == Field::class) {
                    RandomValues.of(checkNotNull(type.arguments[1].type), 31 * (31 * trial + place) + id + 1)
                } else {
                    RandomValues.of(type, 31 * (31 * trial + place))
                }
            }
            // The ids are in the order of a field, in which the device itself (1) is last.
            val expected = runCatching { listOf(0, 2, 1).associateWith { id -> result(plain(types.indices.map { value(it, id) })) } }
            val found = runCatching {
                val fields = types.indices.map { place ->
                    if (types[place].classifier == Field::class) shape.mapValues { value(place, it) } else value(place, 0)
                }
                (call(function, lifted, fields) as Field<*, *>).all.list.associate { it.id to result(it.value) }
            }
            val areEqual = if (expected.isSuccess) {
                found == expected
            } else {
                found.exceptionOrNull()?.javaClass ==
                    expected.exceptionOrNull()?.javaClass
            }
            // The message is created only on failure, because reflection takes milliseconds to print a function.
            if (!areEqual) fail("$function, trial $trial: expected $expected, found $found")
            if (expected.isSuccess && ++succeeded == 3) return
        }
        error("$function never succeeded")
    }

    private fun call(function: KFunction<*>, lifted: Any, values: List<Any?>): Any? = try {
        function.call(lifted, *values.toTypedArray())
    } catch (e: InvocationTargetException) {
        throw e.targetException
    }

    /** Converts a result to a value that can be compared. A type without its own `equals` becomes a list of its contents. */
    private fun shown(value: Any?): Any? = when (value) {
        is BooleanArray -> value.toList()
        is ByteArray -> value.toList()
        is CharArray -> value.toList()
        is Sequence<*> -> value.map(::shown).toList()
        is Iterator<*> -> value.asSequence().map(::shown).toList()
        is Grouping<*, *> -> groups(value)
        is Map<*, *> -> value.mapValues { shown(it.value) } to runCatching { defaulted(value) }.getOrNull()
        is Map.Entry<*, *> -> value.key to value.value
        is Set<*> -> value
        is Collection<*> -> value.map(::shown)
        is ClosedRange<*> -> value
        is Iterable<*> -> value.map(::shown)
        else -> value
    }

    private fun <T> groups(grouping: Grouping<T, *>) = grouping.sourceIterator().asSequence().map { it to grouping.keyOf(it) }.toList()

    @Suppress("UNCHECKED_CAST")
    private fun defaulted(map: Map<*, *>) = (map as Map<Int, Any?>).getValue(100)

    @Test
    fun `a reified type is the type of the caller`() = inRound { shape ->
        val values = shape.mapValues { listOf(it, "$it") }
        assertEquals((0..2).associateWith { listOf("$it") }, values.filterIsInstance<String, Int>().all.toMap())
    }

    @Test
    fun `the result of a lambda chooses the overload`() = inRound { shape ->
        val values = shape.mapValues { listOf(it) }
        val expected = (0..2).associateWith { listOf(it, it) }
        assertEquals(expected, values.flatMap { listOf(it, it) }.all.toMap())
        assertEquals(expected, values.flatMap { sequenceOf(it, it) }.all.toMap())
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

    /** Calls [check] with the field of all ids, in a round of a device with the neighbours 0 and 2. */
    private fun inRound(check: (Field<Int, Int>) -> Unit) {
        val swarm = Swarm(3).line(1.0, 1.0)
        var runs = 0
        swarm.rounds(2) {
            val shape = mapNeighborhood { it }
            if (localId == 1 && shape.neighborCount == 2) {
                runs++
                check(shape)
            }
        }
        assertTrue(runs > 0)
    }

    /** Returns the names of all objects that contain lifted operators. */
    private fun objects(): List<String> {
        val place = File(FieldedInts::class.java.protectionDomain.codeSource.location.toURI())
        val files = if (place.isFile) {
            JarFile(place).use { jar -> jar.entries().toList().map { it.name } }
        } else {
            place.walk().map { it.relativeTo(place).invariantSeparatorsPath }.toList()
        }
        val own = files.filter { it.substringAfterLast('/').startsWith("Fielded") && it.endsWith(".class") && '$' !in it }
        return own.map { it.removeSuffix(".class").replace('/', '.') }.sorted()
    }
}
