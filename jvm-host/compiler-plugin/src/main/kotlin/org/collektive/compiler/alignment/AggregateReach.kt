@file:OptIn(UnsafeDuringIrConstructionAPI::class)

package org.collektive.compiler.alignment

import org.collektive.compiler.names.DslNames
import org.jetbrains.kotlin.builtins.StandardNames
import org.jetbrains.kotlin.ir.IrElement
import org.jetbrains.kotlin.ir.declarations.IrConstructor
import org.jetbrains.kotlin.ir.declarations.IrDeclarationOrigin
import org.jetbrains.kotlin.ir.declarations.IrFunction
import org.jetbrains.kotlin.ir.declarations.IrVariable
import org.jetbrains.kotlin.ir.expressions.IrCallableReference
import org.jetbrains.kotlin.ir.expressions.IrExpression
import org.jetbrains.kotlin.ir.expressions.IrFunctionAccessExpression
import org.jetbrains.kotlin.ir.expressions.IrFunctionExpression
import org.jetbrains.kotlin.ir.expressions.IrFunctionReference
import org.jetbrains.kotlin.ir.expressions.IrGetValue
import org.jetbrains.kotlin.ir.expressions.IrSpreadElement
import org.jetbrains.kotlin.ir.expressions.IrTypeOperatorCall
import org.jetbrains.kotlin.ir.expressions.IrVararg
import org.jetbrains.kotlin.ir.symbols.UnsafeDuringIrConstructionAPI
import org.jetbrains.kotlin.ir.util.getPackageFragment
import org.jetbrains.kotlin.ir.util.isAnonymousObject
import org.jetbrains.kotlin.ir.util.isFunctionTypeOrSubtype
import org.jetbrains.kotlin.ir.util.isLocal
import org.jetbrains.kotlin.ir.util.parentAsClass
import org.jetbrains.kotlin.ir.visitors.IrVisitorVoid
import org.jetbrains.kotlin.ir.visitors.acceptChildrenVoid
import org.jetbrains.kotlin.ir.visitors.acceptVoid

/**
 * Determines which calls can reach a primitive. These are calls with an argument that is an Aggregate, a Field, or a function that may
 * use one. Only such calls are aligned. For all other calls (`sqrt`, `listOf`, getters of a field), alignment makes no difference.
 */
internal class AggregateReach(private val dsl: DslSymbols) {
    private val reachability = Reachability<Search> { (function, fields) ->
        // A constructor runs the initialisers of its class.
        val code = if (function is IrConstructor) function.parentAsClass else function
        Finder(fields).apply { code.acceptChildrenVoid(this) }.found
    }

    /** The search of a function for calls that must be aligned and, with [fields], for fields that are read. */
    private data class Search(val function: IrFunction, val fields: Boolean)

    /** Whether [call], inside an aggregate function, needs its own token on the alignment stack. */
    fun mustAlign(call: IrFunctionAccessExpression): Boolean {
        val callee = call.symbol.owner
        return when {
            dsl.isManualAlignment(callee) || callee.origin == IrDeclarationOrigin.DEFAULT_PROPERTY_ACCESSOR -> false

            // The code of an object literal is part of the enclosing function.
            callee is IrConstructor && callee.parentAsClass.isAnonymousObject -> false

            dsl.isAggregateMember(callee) -> callee.name == DslNames.neighboring || functionArguments(call).any()

            // These functions call no primitives themselves, but may call a function argument that does.
            dsl.isFieldMember(callee) || isKotlinBuiltIn(callee) -> functionArguments(call).any(::passesDslType)

            callee.isLocal && dependsOnPath(callee) -> true

            else -> call.arguments.any { it != null && passesDslType(it) }
        }
    }

    private fun functionArguments(call: IrFunctionAccessExpression): List<IrExpression> =
        call.symbol.owner.parameters.filter { it.type.isFunctionTypeOrSubtype() }.mapNotNull { call.arguments[it] }

    /** Whether [callee] is part of Kotlin's standard library, or an operator such as `==` and `!!`. */
    fun isKotlinBuiltIn(callee: IrFunction) = callee.getPackageFragment().packageFqName.startsWith(StandardNames.BUILT_INS_PACKAGE_NAME)

    private fun passesDslType(value: IrExpression): Boolean = when (value) {
        is IrTypeOperatorCall -> passesDslType(value.argument) || dsl.containsDslType(value.type)

        is IrFunctionExpression -> reachesPrimitive(value.function)

        is IrFunctionReference -> dsl.containsDslType(value.type) || value.arguments.any { it != null && passesDslType(it) } ||
            value.symbol.owner.let { it.isLocal && dependsOnPath(it) }

        is IrCallableReference<*> -> dsl.containsDslType(value.type) || value.arguments.any { it != null && passesDslType(it) }

        is IrVararg -> value.elements.any { passesDslType(if (it is IrSpreadElement) it.expression else it as IrExpression) }

        is IrGetValue -> functionIn(value)?.let(::dependsOnPath) ?: dsl.mayReachPrimitive(value.type)

        else -> dsl.mayReachPrimitive(value.type)
    }

    /** The lambda that initialises the `val` read by [read]; `null` if the initialiser is not a lambda. */
    private fun functionIn(read: IrGetValue): IrFunction? {
        val variable = read.symbol.owner as? IrVariable ?: return null
        if (variable.isVar) return null
        return when (val initializer = variable.initializer) {
            is IrFunctionExpression -> initializer.function
            is IrTypeOperatorCall -> (initializer.argument as? IrFunctionExpression)?.function
            else -> null
        }
    }

    /** Whether [literal], which runs at one place, must be aligned by the call that receives it. */
    private fun reachesPrimitive(literal: IrFunction): Boolean = reachability.reaches(Search(literal, fields = false))

    /** Whether the result of [function] depends on the places of its calls. The fields that it reads are projected there. */
    private fun dependsOnPath(function: IrFunction): Boolean = reachability.reaches(Search(function, fields = true))

    private inner class Finder(private val fields: Boolean) : IrVisitorVoid() {
        var found = false

        override fun visitElement(element: IrElement) {
            if (!found) element.acceptChildrenVoid(this)
        }

        override fun visitExpression(expression: IrExpression) {
            found = found || fields && dsl.isField(expression.type)
            visitElement(expression)
        }

        override fun visitFunctionAccess(expression: IrFunctionAccessExpression) {
            if (dsl.readsLocalEntry(expression)) return
            val callee = expression.symbol
            found = found || callee != dsl.project && mustAlign(expression) || dsl.isManualAlignment(callee.owner)
            visitExpression(expression)
        }
    }
}
