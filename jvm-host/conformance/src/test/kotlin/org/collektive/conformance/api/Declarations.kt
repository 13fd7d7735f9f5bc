package org.collektive.conformance.api

import java.io.File
import kotlin.metadata.ClassKind
import kotlin.metadata.KmClass
import kotlin.metadata.KmClassifier
import kotlin.metadata.KmFunction
import kotlin.metadata.KmProperty
import kotlin.metadata.KmType
import kotlin.metadata.KmTypeParameter
import kotlin.metadata.KmValueParameter
import kotlin.metadata.KmVariance
import kotlin.metadata.Visibility
import kotlin.metadata.declaresDefaultValue
import kotlin.metadata.isInfix
import kotlin.metadata.isNullable
import kotlin.metadata.isOperator
import kotlin.metadata.isReified
import kotlin.metadata.isVar
import kotlin.metadata.jvm.KotlinClassMetadata
import kotlin.metadata.kind
import kotlin.metadata.visibility

/**
 * The public declarations of compiled Kotlin, one per line.
 *
 * The columns are separated by tabs: kind, owner, name, signature, and `operator` or `var`. `core.tsv` has the same format, but also
 * contains details that do not affect a user's sources, such as `inline`, `data` and `value`. Type parameters are numbered, with the
 * prefix C for classes, T for functions and A for aliases.
 */
internal class Declarations {
    private val lines = sortedSetOf<String>()

    /** Adds the declarations in the folder or jar [place]. */
    fun read(place: File) {
        for ((type, metadata) in compiledKotlin(place)) {
            when (metadata) {
                is KotlinClassMetadata.Class -> read(metadata.kmClass)

                is KotlinClassMetadata.FileFacade -> {
                    val owner = type.packageName
                    metadata.kmPackage.functions.filter { it.visibility == Visibility.PUBLIC }.forEach { add(owner, it, emptyMap()) }
                    metadata.kmPackage.properties.filter { it.visibility == Visibility.PUBLIC }.forEach { add(owner, it, emptyMap()) }
                    for (alias in metadata.kmPackage.typeAliases.filter { it.visibility == Visibility.PUBLIC }) {
                        val names = named(alias.typeParameters, "A")
                        add("alias", owner, alias.name, "${parameters(alias.typeParameters, names)} = ${text(alias.expandedType, names)}")
                    }
                }

                else -> {}
            }
        }
    }

    /** Returns all declarations read so far. */
    fun all(): Set<String> = lines

    private fun read(type: KmClass) {
        // The serialization plugin generates classes named $serializer.
        if (type.visibility != Visibility.PUBLIC || type.name.endsWith(".\$serializer")) return
        val owner = type.name.replace('/', '.')
        val names = named(type.typeParameters, "C")
        val supers = type.supertypes.map { text(it, names) }
        add("class", owner, "", "${parameters(type.typeParameters, names)} : $supers")
        if (type.kind != ClassKind.OBJECT && type.kind != ClassKind.COMPANION_OBJECT) {
            for (constructor in type.constructors.filter { it.visibility == Visibility.PUBLIC }) {
                add("ctor", owner, "<init>", values(constructor.valueParameters, names))
            }
        }
        type.functions.filter { it.visibility == Visibility.PUBLIC && it.name !in OF_ANY }.forEach { add(owner, it, names) }
        type.properties.filter { it.visibility == Visibility.PUBLIC }.forEach { add(owner, it, names) }
    }

    @OptIn(ExperimentalContextParameters::class)
    private fun add(owner: String, function: KmFunction, outer: Map<Int, String>) {
        val names = outer + named(function.typeParameters, "T")
        val receiver = function.receiverParameterType?.let { text(it, names) + "." }.orEmpty()
        val context = function.contextParameters.takeIf { it.isNotEmpty() }?.let { "context" + values(it, names) }.orEmpty()
        val head = listOf(context, parameters(function.typeParameters, names), receiver + values(function.valueParameters, names))
        val signature = head.filter { it.isNotEmpty() }.joinToString(" ") + ": " + text(function.returnType, names)
        val modifiers = listOfNotNull("operator".takeIf { function.isOperator }, "infix".takeIf { function.isInfix })
        add("fun", owner, function.name, signature, modifiers.joinToString(" "))
    }

    private fun add(owner: String, property: KmProperty, outer: Map<Int, String>) {
        val names = outer + named(property.typeParameters, "T")
        val receiver = property.receiverParameterType?.let { text(it, names) + "." }.orEmpty()
        val head = listOf(parameters(property.typeParameters, names), receiver).filter { it.isNotEmpty() }.joinToString(" ")
        val isVar = property.isVar && property.setter?.visibility == Visibility.PUBLIC
        add("val", owner, property.name, "$head: ${text(property.returnType, names)}", if (isVar) "var" else "")
    }

    private fun add(kind: String, owner: String, name: String, signature: String, modifier: String = "") {
        lines += listOf(kind, short(owner), name, signature.trim(), modifier).joinToString("\t")
    }

    private fun named(parameters: List<KmTypeParameter>, letter: String) =
        parameters.withIndex().associate { (index, it) -> it.id to "$letter$index" }

    private fun parameters(parameters: List<KmTypeParameter>, names: Map<Int, String>): String {
        if (parameters.isEmpty()) return ""
        return parameters.joinToString(",", "<", ">") { parameter ->
            val bounds = parameter.upperBounds.map { text(it, names) }.filter { it != "Any?" }
            val reified = if (parameter.isReified) "reified " else ""
            reified + names.getValue(parameter.id) + if (bounds.isEmpty()) "" else bounds.joinToString("&", ":")
        }
    }

    private fun values(parameters: List<KmValueParameter>, names: Map<Int, String>): String =
        parameters.joinToString(", ", "(", ")") { parameter ->
            val type = parameter.varargElementType?.let { "vararg ${text(it, names)}" } ?: text(parameter.type, names)
            parameter.name + (if (parameter.declaresDefaultValue) "=@" else "@") + type
        }

    private fun text(type: KmType, names: Map<Int, String>): String {
        val name = when (val classifier = type.classifier) {
            is KmClassifier.Class -> short(classifier.name.replace('/', '.'))
            is KmClassifier.TypeAlias -> short(classifier.name.replace('/', '.'))
            is KmClassifier.TypeParameter -> names.getValue(classifier.id)
        }
        val arguments = type.arguments.joinToString(",") { argument ->
            val (variance, given) = argument
            when {
                given == null -> "*"
                variance == KmVariance.INVARIANT -> text(given, names)
                else -> "${variance?.name?.lowercase()} ${text(given, names)}"
            }
        }
        return name + (if (arguments.isEmpty()) "" else "<$arguments>") + if (type.isNullable) "?" else ""
    }

    companion object {
        private val OF_ANY = setOf("equals", "hashCode", "toString")
        private val SHORT = listOf(
            "it.unibo.collektive.aggregate.api." to "~a.",
            "it.unibo.collektive.aggregate." to "~g.",
            "it.unibo.collektive.stdlib." to "~s.",
            "it.unibo.collektive." to "~.",
            "kotlinx.serialization." to "~k.",
            "kotlin.collections." to "",
            "kotlin." to "",
            "arrow.core." to "arrow.",
        )

        private fun short(name: String): String = SHORT.firstOrNull { name.startsWith(it.first) }
            ?.let { (long, short) -> short + name.removePrefix(long) } ?: name

        /** Converts a line of a table of Collektive's declarations to the format of this class. */
        fun normalized(line: String): String {
            val (kind, owner, name, signature, modifiers) = line.split('\t') + ""
            val kept = modifiers.split(' ').filter { it == "operator" || it == "infix" || it == "var" }
            return listOf(kind, owner, name, signature.trim(), kept.joinToString(" ")).joinToString("\t")
        }
    }
}
