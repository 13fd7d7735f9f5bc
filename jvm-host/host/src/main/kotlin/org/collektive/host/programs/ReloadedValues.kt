package org.collektive.host.programs

import org.collektive.spi.Conversion
import org.collektive.spi.Conversion.Lost
import java.io.ByteArrayInputStream
import java.io.ByteArrayOutputStream
import java.io.InvalidClassException
import java.io.ObjectInputStream
import java.io.ObjectOutputStream
import java.io.ObjectStreamClass
import java.io.OutputStream
import java.lang.reflect.Field
import java.lang.reflect.Modifier
import java.util.Collections
import java.util.EnumMap
import java.util.EnumSet
import java.util.IdentityHashMap
import java.util.PriorityQueue
import java.util.SortedMap
import java.util.SortedSet

/**
 * Converts values of the programs of [old] to those of [new].
 *
 * A value without objects of the user's classes stays the same. Other values are copied by Java serialization, which reads a class by its
 * name and fails if its form has changed.
 */
internal class ReloadedValues(private val old: JarLoader, private val new: JarLoader) : Conversion {
    // Calls by identity, without the line number, which changes when the code above the call changes.
    private val calls = HashMap<String, String>()

    // Objects without objects of the old programs. Values share many objects, such as the paths of a gradient.
    private val unaffected = identitySet()
    private val references = HashMap<Class<*>, List<Field>?>()

    init {
        for (bytes in new.classFiles) for (text in ConstantPool.of(bytes).texts) identityOf(text)?.let { calls[it] = text }
    }

    override fun token(token: Any?): Any? {
        val identity = (token as? String)?.let(::identityOf) ?: return value(token)
        return calls[identity] ?: token
    }

    override fun value(value: Any?): Any? = if (value == null || isSimple(value) || !mayContainOld(value)) value else copy(value)

    /** Returns whether [value] contains an object of the old programs, or may contain one in a class that cannot be read. */
    private fun mayContainOld(value: Any): Boolean {
        val visited = identitySet()
        // Iterative, because lists can be linked to any depth.
        val open = ArrayDeque<Any?>(listOf(value))
        while (open.isNotEmpty()) {
            val next = open.removeLast()
            if (next == null || isSimple(next) || next in unaffected || !visited.add(next)) continue
            if (next.javaClass.classLoader === old) return true
            open.addAll(parts(next) ?: return true)
        }
        unaffected.addAll(visited)
        return false
    }

    /** Returns the objects in [value], or `null` if they cannot be read, as in most classes of the JDK. */
    private fun parts(value: Any): List<Any?>? = when {
        value is Array<*> -> value.asList()
        value.javaClass.isArray -> emptyList()
        value.javaClass.classLoader != null -> referencesOf(value.javaClass)?.map { it.get(value) }
        isEmptyEnumCollection(value) -> null
        value is Collection<*> -> value.toList() + comparatorOf(value)
        value is Map<*, *> -> value.flatMap { listOf(it.key, it.value) } + comparatorOf(value)
        else -> null
    }

    /** Returns the fields of [type] that refer to objects, or `null` if one is not accessible. */
    private fun referencesOf(type: Class<*>): List<Field>? = references.getOrPut(type) {
        generateSequence<Class<*>>(type) { it.superclass }.flatMap { it.declaredFields.asSequence() }
            .filterNot { Modifier.isStatic(it.modifiers) || it.type.isPrimitive }.toList()
            .takeIf { it.all(Field::trySetAccessible) }
    }

    private fun copy(value: Any?): Any? = try {
        val bytes = ByteArrayOutputStream()
        val output = Output(bytes)
        output.use { it.writeObject(value) }
        if (output.hasOld) Input(bytes.toByteArray()).use(ObjectInputStream::readObject) else value
    } catch (_: Throwable) {
        // Code of the user's classes can throw anything.
        Lost
    }

    private inner class Output(bytes: OutputStream) : ObjectOutputStream(bytes) {
        var hasOld = false

        override fun annotateClass(type: Class<*>) {
            if (elementOf(type).classLoader === old) hasOld = true
        }
    }

    private inner class Input(bytes: ByteArray) : ObjectInputStream(ByteArrayInputStream(bytes)) {
        init {
            enableResolveObject(true)
        }

        /** Replaces the second instance of a Kotlin `object` that serialization creates. */
        override fun resolveObject(value: Any?): Any? = value?.let { singleton(it.javaClass) } ?: value

        override fun resolveClass(description: ObjectStreamClass): Class<*> = try {
            Class.forName(description.name, false, new).also(::requireSameForm)
        } catch (_: ClassNotFoundException) {
            // Names of primitive types.
            super.resolveClass(description)
        }

        /** Checks what serialization does not: type arguments, and all fields if the class declares its `serialVersionUID`. */
        private fun requireSameForm(type: Class<*>) {
            if (type.classLoader !== new || type.isArray || Enum::class.java.isAssignableFrom(type)) return
            if (form(type) != form(Class.forName(type.name, false, old))) throw InvalidClassException(type.name, "its fields changed")
        }
    }

    private companion object {
        /** A call of the compiler plugin, such as `share@Swarm.kt:12#9c1d3a5e7f00b2d4`. */
        val CALL = Regex("(.+@[^:]+):\\d+(#[0-9a-f]{16})")

        fun identitySet(): MutableSet<Any> = Collections.newSetFromMap(IdentityHashMap())

        fun identityOf(text: String): String? = CALL.matchEntire(text)?.let { it.groupValues[1] + it.groupValues[2] }

        fun isSimple(value: Any) = value is String || value is Boolean || value is Char || value is Unit ||
            value is Number && value.javaClass.classLoader == null

        /** Returns whether [value] refers only to the class of its future keys or elements. */
        fun isEmptyEnumCollection(value: Any) = value is EnumMap<*, *> && value.isEmpty() || value is EnumSet<*> && value.isEmpty()

        fun comparatorOf(value: Any): Comparator<*>? = when (value) {
            is SortedMap<*, *> -> value.comparator()
            is SortedSet<*> -> value.comparator()
            is PriorityQueue<*> -> value.comparator()
            else -> null
        }

        /** The names and types of the fields that serialization keeps. */
        fun form(type: Class<*>): Map<String, String> = type.declaredFields
            .filterNot { Modifier.isStatic(it.modifiers) || Modifier.isTransient(it.modifiers) }
            .associate { it.name to it.genericType.typeName }

        /** Returns the only instance of a Kotlin `object`, or null for other classes. */
        fun singleton(type: Class<*>): Any? {
            val constructor = type.declaredConstructors.singleOrNull() ?: return null
            if (!Modifier.isPrivate(constructor.modifiers) || constructor.parameterCount > 0) return null
            val field = type.declaredFields.find { it.name == "INSTANCE" && Modifier.isStatic(it.modifiers) && it.type == type }
            return field?.takeIf(Field::trySetAccessible)?.get(null)
        }

        tailrec fun elementOf(type: Class<*>): Class<*> = if (type.isArray) elementOf(type.componentType) else type
    }
}
