package org.collektive.compiler.checks

import org.collektive.compiler.names.DslNames
import org.jetbrains.kotlin.fir.FirElement
import org.jetbrains.kotlin.fir.declarations.FirAnonymousFunction
import org.jetbrains.kotlin.fir.declarations.FirValueParameter
import org.jetbrains.kotlin.fir.expressions.FirAnonymousFunctionExpression
import org.jetbrains.kotlin.fir.expressions.FirExpression
import org.jetbrains.kotlin.fir.expressions.FirFunctionCall
import org.jetbrains.kotlin.fir.expressions.FirPropertyAccessExpression
import org.jetbrains.kotlin.fir.expressions.FirReturnExpression
import org.jetbrains.kotlin.fir.expressions.arguments
import org.jetbrains.kotlin.fir.expressions.resolvedArgumentMapping
import org.jetbrains.kotlin.fir.expressions.unwrapArgument
import org.jetbrains.kotlin.fir.expressions.unwrapSmartcastExpression
import org.jetbrains.kotlin.fir.references.toResolvedVariableSymbol
import org.jetbrains.kotlin.fir.symbols.impl.FirVariableSymbol
import org.jetbrains.kotlin.fir.visitors.FirVisitorVoid

/** The lambda literal that is the last argument of a call, or `null`. */
internal val FirFunctionCall.lambda: FirAnonymousFunction?
    get() = (arguments.lastOrNull()?.unwrapArgument() as? FirAnonymousFunctionExpression)?.anonymousFunction?.takeIf { it.isLambda }

/** The parameter to which this call passes [lambda]; `null` if it does not pass it. */
internal fun FirFunctionCall.parameterOf(lambda: FirAnonymousFunction): FirValueParameter? = resolvedArgumentMapping?.entries
    ?.firstOrNull { (argument) -> (argument.unwrapArgument() as? FirAnonymousFunctionExpression)?.anonymousFunction === lambda }?.value

/** The variable or parameter that an expression reads; `null` for any other expression. */
internal val FirExpression.readVariable: FirVariableSymbol<*>?
    get() = (unwrapSmartcastExpression() as? FirPropertyAccessExpression)?.takeIf { it.explicitReceiver == null }
        ?.calleeReference?.toResolvedVariableSymbol()

/** The expression that is the whole body of a lambda; `null` if the body is longer. */
internal val FirAnonymousFunction.onlyExpression: FirExpression?
    get() = when (val statement = body?.statements?.singleOrNull()) {
        is FirReturnExpression -> statement.result
        else -> statement as? FirExpression
    }

/** Whether [predicate] holds for this element or one inside it. */
internal fun FirElement.contains(predicate: (FirElement) -> Boolean): Boolean {
    var found = false
    accept(
        object : FirVisitorVoid() {
            override fun visitElement(element: FirElement) {
                found = found || predicate(element)
                if (!found) element.acceptChildren(this)
            }
        },
    )
    return found
}

internal fun FirFunctionCall.isAnyOf(names: Set<String>): Boolean = callee?.let { callee ->
    callee.callableId.packageName == DslNames.apiPackage && callee.callableId.callableName.asString() in names
} == true
