package org.collektive.compiler.checks

import org.jetbrains.kotlin.fir.FirElement
import org.jetbrains.kotlin.fir.analysis.checkers.context.CheckerContext
import org.jetbrains.kotlin.fir.declarations.FirAnonymousFunction
import org.jetbrains.kotlin.fir.declarations.FirAnonymousInitializer
import org.jetbrains.kotlin.fir.declarations.FirFunction
import org.jetbrains.kotlin.fir.expressions.FirArgumentList
import org.jetbrains.kotlin.fir.expressions.FirBlock
import org.jetbrains.kotlin.fir.expressions.FirCatch
import org.jetbrains.kotlin.fir.expressions.FirElvisExpression
import org.jetbrains.kotlin.fir.expressions.FirExpression
import org.jetbrains.kotlin.fir.expressions.FirFunctionCall
import org.jetbrains.kotlin.fir.expressions.FirLoop
import org.jetbrains.kotlin.fir.expressions.FirReturnExpression
import org.jetbrains.kotlin.fir.expressions.FirSafeCallExpression
import org.jetbrains.kotlin.fir.expressions.FirTryExpression
import org.jetbrains.kotlin.fir.expressions.FirWhenBranch
import org.jetbrains.kotlin.fir.expressions.FirWhenExpression
import org.jetbrains.kotlin.fir.types.ConeTypeParameterType
import org.jetbrains.kotlin.fir.types.coneType
import org.jetbrains.kotlin.fir.types.isUnit
import org.jetbrains.kotlin.fir.types.resolvedType
import org.jetbrains.kotlin.fir.types.type

/**
 * Whether the value of [expression] is used. [expression] is the one under check, or the result of the `return` under check.
 * The compiler's own flag `usedAsExpression` of `when` covers neither the last expression of a lambda nor `?:`.
 */
context(context: CheckerContext)
internal fun isValueUsed(expression: FirExpression): Boolean {
    var inner: FirElement = expression
    val outwards = context.containingElements.asReversed().iterator()
    while (outwards.hasNext()) {
        val outer = outwards.next()
        when (outer) {
            is FirBlock -> if (outer.statements.last() !== inner) return false

            // An `if` without `else` has no value even at the end of a lambda.
            is FirWhenExpression -> if (outer.resolvedType.isUnit) return false

            is FirWhenBranch -> if (outer.result !== inner) return true

            is FirTryExpression -> if (outer.finallyBlock === inner) return false

            is FirSafeCallExpression -> if (outer.selector !== inner) return true

            is FirElvisExpression, is FirCatch -> Unit

            is FirLoop -> return outer.block !== inner

            is FirReturnExpression -> {
                val function = outer.target.labeledElement
                if (function !is FirAnonymousFunction) return true
                while (outwards.hasNext() && outwards.next() !== function) continue
                inner = function
                continue
            }

            // The value of a function is always the result of an explicit or implicit `return`.
            is FirFunction, is FirAnonymousInitializer -> return false

            is FirArgumentList -> if (inner is FirAnonymousFunction) continue else return true

            is FirFunctionCall -> if (inner !is FirAnonymousFunction || !outer.returnsValueOf(inner)) return true

            else -> return true
        }
        inner = outer
    }
    return true
}

/** Whether this call returns the result of [lambda], as with `run` and `let`. */
private fun FirFunctionCall.returnsValueOf(lambda: FirAnonymousFunction): Boolean {
    val result = parameterOf(lambda)?.returnTypeRef?.coneType?.typeArguments?.lastOrNull()?.type
    return result is ConeTypeParameterType && result == callee?.resolvedReturnType
}
