package org.collektive.compiler.checks

import org.collektive.compiler.DslNames
import org.jetbrains.kotlin.fir.analysis.checkers.context.CheckerContext
import org.jetbrains.kotlin.fir.declarations.hasAnnotation
import org.jetbrains.kotlin.fir.symbols.impl.FirFunctionSymbol
import org.jetbrains.kotlin.fir.types.coneType

/** Whether the expression being checked lies in an aggregate function, so that the compiler aligns it. */
context(context: CheckerContext)
internal fun isAggregateCode(): Boolean {
    val session = context.session
    if (context.containingFileSymbol?.hasAnnotation(DslNames.ignore, session) == true) return false
    if (context.containingDeclarations.any { it.hasAnnotation(DslNames.ignore, session) }) return false
    return context.containingDeclarations.any { it is FirFunctionSymbol<*> && isAggregateFunction(it) }
}

context(context: CheckerContext)
private fun isAggregateFunction(function: FirFunctionSymbol<*>): Boolean = with(context.session) {
    val types = function.contextParameterSymbols.map { it.resolvedReturnType } + listOfNotNull(function.resolvedReceiverType) +
        function.valueParameterSymbols.map { it.resolvedReturnType }
    types.any { it.isAggregate() || it.isField() }
}
