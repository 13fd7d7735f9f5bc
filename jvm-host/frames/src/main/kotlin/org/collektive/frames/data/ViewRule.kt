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

/** Rejects values that are, or contain, a view of a frame. Frames are pooled memory, so a view must not outlive its round. */
public object ViewRule : SharingRule {
    override fun refusal(value: Any?): String? {
        val view = viewIn(value, 0) ?: return null
        val where = if (view === value) "" else " inside a ${value?.javaClass?.name}"
        return "a ${view.javaClass.name}$where is a view of the frame's memory and valid only during this round: " +
            "copy its values (into numbers, a data class or an array) and share or store the copy"
    }

    /** Returns the first view that [value] is or contains, or `null`. */
    private fun viewIn(value: Any?, depth: Int): Any? {
        if (value == null) return null
        return when (val kind = KINDS.get(value.javaClass)) {
            NoView -> null
            IsView -> value
            else -> if (depth == MAX_DEPTH) null else (kind as Container).find(value, depth + 1)
        }
    }

    /** Finds views in values of one class; computed once per class. */
    private sealed interface ClassKind

    /** A class that neither is nor contains a view. */
    private object NoView : ClassKind

    private object IsView : ClassKind

    private abstract class Container : ClassKind {
        /** Returns the first view that [value] contains; [depth] is the nesting level of its content. */
        abstract fun find(value: Any, depth: Int): Any?
    }

    private object IterableElements : Container() {
        override fun find(value: Any, depth: Int): Any? {
            if (value is List<*> && value is RandomAccess) {
                for (index in value.indices) viewIn(value[index], depth)?.let { return it }
                return null
            }
            return (value as Iterable<*>).firstNotNullOfOrNull { viewIn(it, depth) }
        }
    }

    private object ArrayElements : Container() {
        override fun find(value: Any, depth: Int): Any? = (value as Array<*>).firstNotNullOfOrNull { viewIn(it, depth) }
    }

    private object MapEntries : Container() {
        override fun find(value: Any, depth: Int): Any? {
            for ((key, content) in value as Map<*, *>) (viewIn(key, depth) ?: viewIn(content, depth))?.let { return it }
            return null
        }
    }

    private object PairElements : Container() {
        override fun find(value: Any, depth: Int): Any? = (value as Pair<*, *>).let { viewIn(it.first, depth) ?: viewIn(it.second, depth) }
    }

    /** A class of the JDK that contains one value, which [content] returns. */
    private class SingleValue(private val content: (Any) -> Any?) : Container() {
        override fun find(value: Any, depth: Int): Any? = viewIn(content(value), depth)
    }

    private class ObjectFields(private val fields: Array<Field>) : Container() {
        override fun find(value: Any, depth: Int): Any? {
            for (field in fields) viewIn(field.get(value), depth)?.let { return it }
            return null
        }
    }

    private val KINDS = object : ClassValue<ClassKind>() {
        override fun computeValue(type: Class<*>): ClassKind = kindOf(type, emptySet())
    }

    private val VIEWS = listOf(Table::class.java, Struct::class.java, BaseVector::class.java, ByteBuffer::class.java)

    private fun kindOf(type: Class<*>, visiting: Set<Class<*>>): ClassKind = when {
        VIEWS.any { it.isAssignableFrom(type) } -> IsView

        type.isPrimitive || type.isEnum || type.componentType?.isPrimitive == true -> NoView

        type.isArray -> ArrayElements

        type == Pair::class.java -> PairElements

        type == Optional::class.java -> SingleValue { (it as Optional<*>).orElse(null) }

        AtomicReference::class.java.isAssignableFrom(type) -> SingleValue { (it as AtomicReference<*>).get() }

        Iterable::class.java.isAssignableFrom(type) -> IterableElements

        Map::class.java.isAssignableFrom(type) -> MapEntries

        // Reflection cannot read the fields of other JDK classes.
        type.name.startsWith("java.") -> NoView

        else -> {
            val fields = fieldsOf(type).filter { mayContainView(it.type, visiting + type) && it.trySetAccessible() }
            if (fields.isEmpty()) NoView else ObjectFields(fields.toTypedArray())
        }
    }

    /** Returns whether a field of [type] may contain a view. True for the recursive classes in [visiting], whose search is in progress. */
    private fun mayContainView(type: Class<*>, visiting: Set<Class<*>>): Boolean = when {
        type in visiting || VIEWS.any { it.isAssignableFrom(type) } -> true
        type.isPrimitive -> false
        Modifier.isFinal(type.modifiers) -> kindOf(type, visiting) != NoView
        else -> type == Any::class.java || type == Iterable::class.java || !type.name.startsWith("java.lang.")
    }

    private fun fieldsOf(type: Class<*>): List<Field> =
        generateSequence(type) { it.superclass }.takeWhile { it != Any::class.java }.flatMap { it.declaredFields.asSequence() }
            .filter { !Modifier.isStatic(it.modifiers) }.toList()

    private const val MAX_DEPTH = 4
}
