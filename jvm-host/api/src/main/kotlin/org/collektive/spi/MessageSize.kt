package org.collektive.spi

import java.lang.reflect.Field
import java.lang.reflect.Modifier
import java.util.IdentityHashMap

/**
 * The values and bytes of one message, as a compact binary format would encode them. Not thread-safe.
 *
 * A value takes [PATH_BYTES] for its path, plus 1 for `Boolean`, `Byte` and `null`, 2 for `Short` and `Char`, 4 for `Int`, `Float`
 * and enums, 8 for `Long` and `Double`, and 0 for `Unit` and other objects without properties. Strings take 4 bytes plus their UTF-8;
 * collections, maps and arrays take 4 bytes plus their elements. Other objects take the sum of their properties, JDK objects as their text.
 * A value for a single receiver is added with the receiver's id, but only if it differs from the value for all other receivers.
 */
public class MessageSize {
    private val seen = IdentityHashMap<Any, Unit>()

    /** Number of values. */
    public var values: Int = 0
        private set

    /** Number of bytes. */
    public var bytes: Int = 0
        private set

    /** Adds a value for all receivers. */
    public fun add(value: Any?) {
        values++
        addBytes(PATH_BYTES)
        addValue(value)
    }

    /** Adds a value that the [receiver] gets in place of the last added value. */
    public fun addFor(receiver: Any, value: Any?) {
        addValue(receiver)
        addValue(value)
    }

    /** Starts the next message. */
    public fun clear() {
        values = 0
        bytes = 0
    }

    private fun addBytes(count: Int) {
        bytes = (bytes.toLong() + count).coerceAtMost(Int.MAX_VALUE.toLong()).toInt()
    }

    private fun addValue(value: Any?) {
        when (value) {
            null, is Boolean, is Byte -> addBytes(1)
            is Short, is Char -> addBytes(Short.SIZE_BYTES)
            is Int, is Float, is Enum<*> -> addBytes(Int.SIZE_BYTES)
            is Long, is Double -> addBytes(Long.SIZE_BYTES)
            is CharSequence -> addBytes(LENGTH_BYTES + value.toString().encodeToByteArray().size)
            is BooleanArray -> addBytes(LENGTH_BYTES + value.size)
            is ByteArray -> addBytes(LENGTH_BYTES + value.size)
            is ShortArray -> addBytes(LENGTH_BYTES + Short.SIZE_BYTES * value.size)
            is CharArray -> addBytes(LENGTH_BYTES + Short.SIZE_BYTES * value.size)
            is IntArray -> addBytes(LENGTH_BYTES + Int.SIZE_BYTES * value.size)
            is FloatArray -> addBytes(LENGTH_BYTES + Int.SIZE_BYTES * value.size)
            is LongArray -> addBytes(LENGTH_BYTES + Long.SIZE_BYTES * value.size)
            is DoubleArray -> addBytes(LENGTH_BYTES + Long.SIZE_BYTES * value.size)
            else -> addObject(value)
        }
    }

    /** Adds an object, unless it contains itself. */
    private fun addObject(value: Any) {
        if (seen.put(value, Unit) != null) return
        when (value) {
            is Array<*> -> addAll(value.asIterable())

            is Collection<*> -> addAll(value)

            is Map<*, *> -> {
                addAll(value.keys)
                value.values.forEach(::addValue)
            }

            else -> {
                val fields = FIELDS.get(value.javaClass)
                if (fields == null) addValue(value.toString()) else for (field in fields) addValue(field.get(value))
            }
        }
        seen.remove(value)
    }

    private fun addAll(values: Iterable<*>) {
        addBytes(LENGTH_BYTES)
        values.forEach(::addValue)
    }

    public companion object {
        /** Size of a path in bytes. A network would send paths as hashes. */
        public const val PATH_BYTES: Int = 8

        private const val LENGTH_BYTES = 4

        /** The fields of a class and of its superclasses; `null` for classes whose fields are not accessible. */
        private val FIELDS = object : ClassValue<List<Field>?>() {
            override fun computeValue(type: Class<*>): List<Field>? {
                val fields = generateSequence<Class<*>>(type) { it.superclass }.flatMap { it.declaredFields.asSequence() }
                    .filterNot { Modifier.isStatic(it.modifiers) || Modifier.isTransient(it.modifiers) }.toList()
                return fields.takeIf { it.all(Field::trySetAccessible) }
            }
        }
    }
}
