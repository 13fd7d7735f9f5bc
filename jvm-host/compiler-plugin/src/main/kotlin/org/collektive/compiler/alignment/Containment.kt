@file:OptIn(UnsafeDuringIrConstructionAPI::class)

package org.collektive.compiler.alignment

import org.jetbrains.kotlin.ir.IrElement
import org.jetbrains.kotlin.ir.declarations.IrClass
import org.jetbrains.kotlin.ir.expressions.IrExpression
import org.jetbrains.kotlin.ir.symbols.UnsafeDuringIrConstructionAPI
import org.jetbrains.kotlin.ir.types.IrSimpleType
import org.jetbrains.kotlin.ir.types.IrType
import org.jetbrains.kotlin.ir.types.getClass
import org.jetbrains.kotlin.ir.types.typeOrNull
import org.jetbrains.kotlin.ir.util.isLocal
import org.jetbrains.kotlin.ir.util.parentAsClass
import org.jetbrains.kotlin.ir.util.properties
import org.jetbrains.kotlin.ir.visitors.IrVisitorVoid
import org.jetbrains.kotlin.ir.visitors.acceptChildrenVoid

/**
 * Determines which values are or may contain a value of a target type, directly or through other objects. An object may contain one if
 * one of the [classes] of the module is a subclass of its type and stores one, or is local and uses one.
 */
internal class Containment(private val dsl: DslSymbols, classes: List<IrClass>, private val isTarget: (IrType) -> Boolean) {
    private var bases = emptySet<IrClass>()
    private var storing = newSearch()

    init {
        do {
            val known = bases.size
            bases = classes.filter { isStoredIn(it) || it.isLocal && isUsedIn(it) }.flatMapTo(HashSet(), ::supertypes)
            storing = newSearch()
        } while (bases.size > known)
    }

    fun isIn(type: IrType): Boolean = isTarget(type) ||
        type is IrSimpleType && type.arguments.any { argument -> argument.typeOrNull?.let(::isIn) == true } ||
        type.getClass()?.let(::isStoredIn) == true

    /** Whether the code in [element] has a value that is or may contain one of a target type. */
    fun isUsedIn(element: IrElement): Boolean {
        var isUsed = false
        element.acceptChildrenVoid(object : IrVisitorVoid() {
            override fun visitElement(element: IrElement) {
                isUsed = isUsed || element is IrExpression && isIn(element.type)
                if (!isUsed) element.acceptChildrenVoid(this)
            }
        })
        return isUsed
    }

    private fun isStoredIn(type: IrClass): Boolean = !dsl.isPlatform(type) && (type in bases || storing.reaches(type))

    private fun newSearch() = Reachability<IrClass> { type ->
        dsl.aggregateProperty(type) != null || type.properties.any { property -> property.backingField?.type?.let(::isIn) == true } ||
            type.isInner && isStoredIn(type.parentAsClass)
    }

    private fun supertypes(type: IrClass): List<IrClass> = type.superTypes.mapNotNull { it.getClass() }.flatMap { supertypes(it) + it }
}
