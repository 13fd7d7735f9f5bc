package org.collektive.frames.data

import com.google.flatbuffers.BaseVector
import com.google.flatbuffers.Struct
import com.google.flatbuffers.Table
import org.collektive.spi.SharingRule
import java.lang.reflect.Field
import java.lang.reflect.Modifier
import java.nio.ByteBuffer
import java.util.Optional
import java.util.concurrent.atomic.AtomicReference

/** Rejects values that are or contain a view of a frame: frames are pooled memory, so a view must not outlive its round. */
public object ViewRule : SharingRule {
    override fun refusal(value: Any?): String? {
        val view = viewIn(value, 0) ?: return null
        val where = if (view === value) "" else " inside a ${value?.javaClass?.name}"
        return "a ${view.javaClass.name}$where is a view of this tick's memory and is valid in this round only: " +
            "take the values out of it (a number, a data class, an array)"
    }

    /** The first view that [value] is or contains. */
    private fun viewIn(value: Any?, depth: Int): Any? {
        if (value == null) return null
        return when (val shape = SHAPES.get(value.javaClass)) {
            Plain -> null
            View -> value
            else -> if (depth == MAX_DEPTH) null else (shape as Holder).find(value, depth + 1)
        }
    }

    /** How to search values of one class; computed once per class. */
    private sealed interface Shape

    /** Neither is nor contains a view. */
    private object Plain : Shape

    private object View : Shape

    private abstract class Holder : Shape {
        /** The first view that [value] contains; [depth] is its nesting level in the shared value. */
        abstract fun find(value: Any, depth: Int): Any?
    }

    private object Elements : Holder() {
        override fun find(value: Any, depth: Int): Any? {
            if (value is List<*> && value is RandomAccess) {
                for (index in value.indices) viewIn(value[index], depth)?.let { return it }
                return null
            }
            return (value as Iterable<*>).firstNotNullOfOrNull { viewIn(it, depth) }
        }
    }

    private object Slots : Holder() {
        override fun find(value: Any, depth: Int): Any? = (value as Array<*>).firstNotNullOfOrNull { viewIn(it, depth) }
    }

    private object Entries : Holder() {
        override fun find(value: Any, depth: Int): Any? {
            for ((key, content) in value as Map<*, *>) (viewIn(key, depth) ?: viewIn(content, depth))?.let { return it }
            return null
        }
    }

    private object Two : Holder() {
        override fun find(value: Any, depth: Int): Any? = (value as Pair<*, *>).let { viewIn(it.first, depth) ?: viewIn(it.second, depth) }
    }

    /** A class of the JDK that holds one value, which [content] returns. */
    private class One(private val content: (Any) -> Any?) : Holder() {
        override fun find(value: Any, depth: Int): Any? = viewIn(content(value), depth)
    }

    private class Fields(private val fields: Array<Field>) : Holder() {
        override fun find(value: Any, depth: Int): Any? {
            for (field in fields) viewIn(field.get(value), depth)?.let { return it }
            return null
        }
    }

    private val SHAPES = object : ClassValue<Shape>() {
        override fun computeValue(type: Class<*>): Shape = shapeOf(type, emptySet())
    }

    private val VIEWS = listOf(Table::class.java, Struct::class.java, BaseVector::class.java, ByteBuffer::class.java)

    private fun shapeOf(type: Class<*>, open: Set<Class<*>>): Shape = when {
        VIEWS.any { it.isAssignableFrom(type) } -> View

        type.isPrimitive || type.isEnum || type.componentType?.isPrimitive == true -> Plain

        type.isArray -> Slots

        type == Pair::class.java -> Two

        type == Optional::class.java -> One { (it as Optional<*>).orElse(null) }

        AtomicReference::class.java.isAssignableFrom(type) -> One { (it as AtomicReference<*>).get() }

        Iterable::class.java.isAssignableFrom(type) -> Elements

        Map::class.java.isAssignableFrom(type) -> Entries

        // Reflection cannot read the fields of other JDK classes.
        type.name.startsWith("java.") -> Plain

        else -> {
            val fields = fieldsOf(type).filter { mayHoldView(it.type, open + type) && it.trySetAccessible() }
            if (fields.isEmpty()) Plain else Fields(fields.toTypedArray())
        }
    }

    /** Whether a field of [type] may contain a view. True for the classes in [open], which are being examined: they contain themselves. */
    private fun mayHoldView(type: Class<*>, open: Set<Class<*>>): Boolean = when {
        type in open || VIEWS.any { it.isAssignableFrom(type) } -> true
        type.isPrimitive -> false
        Modifier.isFinal(type.modifiers) -> shapeOf(type, open) != Plain
        else -> type == Any::class.java || type == Iterable::class.java || !type.name.startsWith("java.lang.")
    }

    private fun fieldsOf(type: Class<*>): List<Field> =
        generateSequence(type) { it.superclass }.takeWhile { it != Any::class.java }.flatMap { it.declaredFields.asSequence() }
            .filter { !Modifier.isStatic(it.modifiers) }.toList()

    private const val MAX_DEPTH = 4
}
