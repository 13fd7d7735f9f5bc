package org.collektive.compiler.checks

import org.collektive.compiler.names.DslNames
import org.jetbrains.kotlin.descriptors.Visibilities
import org.jetbrains.kotlin.fir.FirSession
import org.jetbrains.kotlin.fir.analysis.checkers.context.CheckerContext
import org.jetbrains.kotlin.fir.declarations.declaredProperties
import org.jetbrains.kotlin.fir.declarations.hasAnnotation
import org.jetbrains.kotlin.fir.declarations.utils.hasBackingField
import org.jetbrains.kotlin.fir.declarations.utils.isAbstract
import org.jetbrains.kotlin.fir.declarations.utils.visibility
import org.jetbrains.kotlin.fir.resolve.toRegularClassSymbol
import org.jetbrains.kotlin.fir.symbols.impl.FirClassSymbol
import org.jetbrains.kotlin.fir.symbols.impl.FirFunctionSymbol
import org.jetbrains.kotlin.fir.types.coneType

/** Whether the expression under check is part of an aggregate function, which the plugin aligns. */
context(context: CheckerContext)
internal fun isAggregateCode(): Boolean {
    val session = context.session
    if (context.containingFileSymbol?.hasAnnotation(DslNames.ignore, session) == true) return false
    if (context.containingDeclarations.any { it.hasAnnotation(DslNames.ignore, session) }) return false
    return context.containingDeclarations.any {
        it is FirFunctionSymbol<*> && isAggregateFunction(it) || it is FirClassSymbol<*> && storesAggregate(it)
    }
}

/** Whether an object of [type] stores the Aggregate of its program in a property. Excludes implementations of Aggregate. */
context(context: CheckerContext)
private fun storesAggregate(type: FirClassSymbol<*>): Boolean = with(context.session) {
    type.resolvedSuperTypes.none { it.isAggregate() } &&
        (declaresAggregate(type) || inherited(type).any { declaresAggregate(it, isInherited = true) })
}

context(session: FirSession)
private fun inherited(type: FirClassSymbol<*>): Sequence<FirClassSymbol<*>> = type.resolvedSuperTypes.asSequence()
    .mapNotNull { it.toRegularClassSymbol(session) }.flatMap { sequenceOf(it) + inherited(it) }

context(session: FirSession)
private fun declaresAggregate(type: FirClassSymbol<*>, isInherited: Boolean = false): Boolean = type.declaredProperties(session).any {
    !it.isVar && !it.hasDelegate && (it.hasBackingField || it.isAbstract) && !(isInherited && it.visibility == Visibilities.Private) &&
        it.resolvedReturnType.isAggregate()
}

context(context: CheckerContext)
private fun isAggregateFunction(function: FirFunctionSymbol<*>): Boolean = with(context.session) {
    val types = function.contextParameterSymbols.map { it.resolvedReturnType } + listOfNotNull(function.resolvedReceiverType) +
        function.valueParameterSymbols.map { it.resolvedReturnType }
    types.any { it.isAggregate() || it.isField() }
}
