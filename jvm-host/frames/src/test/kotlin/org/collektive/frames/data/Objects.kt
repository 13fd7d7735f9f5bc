package org.collektive.frames.data

import com.google.flatbuffers.Table
import com.google.flatbuffers.reflection.Schema
import java.lang.reflect.Method
import java.lang.reflect.Modifier
import java.lang.reflect.ParameterizedType
import java.lang.reflect.Type
import java.nio.ByteBuffer
import java.util.Random
import java.lang.reflect.Array as ReflectArray

/** Creates and prints random data of any schema, as objects of flatc's object API, as program results and as maps. */
internal object Objects {
    /**
     * Returns the data as canonical text, identical to the text that the C# tests print.
     *
     * Members are sorted by their names in C#. Floating-point numbers are printed as bits, integers as signed 64-bit numbers, and absent
     * lists as empty lists.
     */
    fun dump(data: Any?): String = buildString { append(data, data?.javaClass) }

    private fun StringBuilder.append(data: Any?, type: Class<*>?) {
        when {
            type != null && type.isArray -> {
                append('[')
                if (data != null) {
                    for (i in 0 until ReflectArray.getLength(data)) {
                        append(ReflectArray.get(data, i), type.componentType)
                        append(' ')
                    }
                }
                append(']')
            }

            data == null -> append(if (type == List::class.java) "[]" else "null")

            data is String -> append('"').append(data).append('"')

            data is Boolean -> append(data.toString())

            data is Float -> append('f').append(java.lang.Float.floatToRawIntBits(data))

            data is Double -> append('d').append(java.lang.Double.doubleToRawLongBits(data))

            data is Number -> append(data.toLong())

            data is List<*> -> {
                append('[')
                for (item in data) {
                    append(item, item?.javaClass)
                    append(' ')
                }
                append(']')
            }

            data is Map<*, *> -> {
                append('{')
                for ((name, value) in data.mapKeys { (name, _) -> normal("$name") }.toSortedMap()) {
                    append(name).append('=')
                    append(value, value?.javaClass)
                    append(' ')
                }
                append('}')
            }

            else -> {
                append('{')
                for ((name, getter) in getters(data.javaClass)) {
                    append(name).append('=')
                    append(getter.invoke(data), getter.returnType)
                    append(' ')
                }
                append('}')
            }
        }
    }

    private fun getters(type: Class<*>): Map<String, Method> =
        type.declaredMethods.filter { it.name.startsWith("get") && it.parameterCount == 0 }
            .associateBy { normal(it.name.removePrefix("get")) }.toSortedMap()

    /** Returns the name of a member in generated C#, because languages have different forms. */
    private fun normal(name: String): String = name.split('_').joinToString("") { it.replaceFirstChar(Char::uppercaseChar) }

    /** Returns a valid random object of flatc's class [type]. */
    fun random(type: Class<*>, random: Random): Any = randomObject(type, random, 0)

    /** Returns a valid random result of programs for [schema]. */
    fun randomResult(schema: DataSchema, random: Random): Any =
        randomResult(Schema.getRootAsSchema(ByteBuffer.wrap(binarySchema(schema))), schema.actuatorType, random, 0)

    /** Creates a result or a part of one, with the constructor that has a parameter for each field. */
    private fun randomResult(schema: Schema, type: Class<*>, random: Random, nesting: Int): Any {
        val constructor = type.constructors.filter { !it.isSynthetic }.maxBy { it.parameterCount }
        val names = type.declaredFields.filter { !Modifier.isStatic(it.modifiers) }.map { normal(it.name) }
        val definition = checkNotNull(schema.objectsByKey(type.name) ?: schema.objectsByKey(type.name.removeSuffix("Value")))
        val required = List(definition.fieldsLength(), definition::fields).filter { it.required() }
            .map { normal(it.name()) }
        val values = constructor.genericParameterTypes.mapIndexed { index, part ->
            val canBeAbsent = !(part is Class<*> && part.isPrimitive) && names[index] !in required && !definition.isStruct
            if (canBeAbsent && (random.nextBoolean() || nesting >= MAX_NESTING)) {
                null
            } else {
                value(part, random, nesting) { randomResult(schema, it, random, nesting + 1) }
            }
        }
        return constructor.newInstance(*values.toTypedArray())
    }

    private fun randomObject(type: Class<*>, random: Random, nesting: Int): Any {
        val instance = type.getConstructor().newInstance()
        for (setter in type.methods.filter { it.name.startsWith("set") && it.parameterCount == 1 }.sortedBy { it.name }) {
            val part = setter.parameterTypes[0]
            // Let half of the scalars keep the schema's default.
            if (part.isPrimitive && random.nextBoolean()) continue
            val absent = isTable(type) && normal(setter.name.removePrefix("set")) !in REQUIRED && !part.isPrimitive &&
                (random.nextBoolean() || nesting >= MAX_NESTING)
            val value = if (absent) null else value(part, random, nesting) { randomObject(it, random, nesting + 1) }
            // flatc does not write an optional scalar that is 0.
            val isLost = isBoxed(part) && (value == false || (value as? Number)?.toDouble() == 0.0)
            setter.invoke(instance, if (isLost) null else value)
        }
        return instance
    }

    /** Returns a random value for a field. Structs and tables come from [part]. */
    private fun value(type: Type, random: Random, nesting: Int, part: (Class<*>) -> Any): Any = when {
        type !is Class<*> -> {
            val element = (type as ParameterizedType).actualTypeArguments.single()
            List(if (nesting >= MAX_NESTING) 0 else random.nextInt(4)) { value(element, random, nesting, part) }
        }

        type.isPrimitive -> scalar(type, random)

        isBoxed(type) -> scalar(type.kotlin.javaPrimitiveType ?: type, random)

        type == String::class.java -> text(random)

        type.isArray -> array(type.componentType, random, nesting, part)

        else -> part(type)
    }

    /** Returns whether flatc's class [type] represents a table, according to its reader. */
    private fun isTable(type: Class<*>): Boolean =
        Table::class.java.isAssignableFrom(type.classLoader.loadClass(type.name.removeSuffix("T")))

    private fun array(element: Class<*>, random: Random, nesting: Int, part: (Class<*>) -> Any): Any {
        val count = if (nesting >= MAX_NESTING) 0 else random.nextInt(4)
        val array = ReflectArray.newInstance(element, count)
        for (i in 0 until count) ReflectArray.set(array, i, value(element, random, nesting, part))
        return array
    }

    /** Returns a random number in the range of every schema type that has this Java type. Unsigned types have a wider Java type. */
    private fun scalar(type: Class<*>, random: Random): Any = when (type) {
        Boolean::class.javaPrimitiveType -> random.nextBoolean()
        Byte::class.javaPrimitiveType -> random.nextInt(256).toByte()
        Short::class.javaPrimitiveType -> random.nextInt(65536).toShort()
        Int::class.javaPrimitiveType -> random.nextInt(100)
        Long::class.javaPrimitiveType -> random.nextInt().toLong() and 0x7FFFFFFF
        Float::class.javaPrimitiveType -> random.nextFloat() * 2e3f - 1e3f
        else -> random.nextDouble() * 2e3 - 1e3
    }

    private fun text(random: Random): String =
        listOf("", "a", "node 7", "\u00e9t\u00e9", "\u6e2f", "\ud83d\ude80 up", "x".repeat(300))[random.nextInt(7)]

    private fun isBoxed(type: Type) = type is Class<*> && !type.isPrimitive && type.kotlin.javaPrimitiveType != null

    private const val MAX_NESTING = 4

    /** The required fields of the test schemas. */
    private val REQUIRED: Set<String> = setOf("Label", "Anchor", "Points", "Main", "Name", "Corner")
}
