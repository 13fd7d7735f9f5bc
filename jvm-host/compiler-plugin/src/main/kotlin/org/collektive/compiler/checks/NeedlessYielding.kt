package org.collektive.compiler.checks

import org.collektive.compiler.names.DslNames
import org.jetbrains.kotlin.diagnostics.DiagnosticReporter
import org.jetbrains.kotlin.diagnostics.reportOn
import org.jetbrains.kotlin.fir.analysis.checkers.MppCheckerKind
import org.jetbrains.kotlin.fir.analysis.checkers.context.CheckerContext
import org.jetbrains.kotlin.fir.analysis.checkers.expression.FirExpressionChecker
import org.jetbrains.kotlin.fir.expressions.FirExpression
import org.jetbrains.kotlin.fir.expressions.FirFunctionCall
import org.jetbrains.kotlin.fir.expressions.FirThisReceiverExpression
import org.jetbrains.kotlin.text

/**
 * Reports `x.yielding { this }` and `x.yielding { x }`, where `x` is any expression. Both return the value that they store, as the simpler
 * primitive does.
 */
internal object NeedlessYielding : FirExpressionChecker<FirFunctionCall>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirFunctionCall) {
        if (expression.callee?.callableId?.classId != DslNames.yieldingContext || expression.calleeReference.name != DslNames.yielding) {
            return
        }
        val lambda = expression.lambda ?: return
        val returned = lambda.onlyExpression ?: return
        val stored = expression.extensionReceiver?.readVariable
        val isSame = returned is FirThisReceiverExpression &&
            returned.calleeReference.boundSymbol == lambda.receiverParameter?.symbol ||
            stored != null && returned.readVariable == stored ||
            returned.hasSameText(expression.extensionReceiver)
        if (isSame && isAggregateCode()) reporter.reportOn(expression.source, AggregateDiagnostics.NEEDLESS_YIELDING)
    }

    /** Whether both expressions have the same text, so that `f(x).yielding { f(x) }` returns the value that it stores. */
    private fun FirExpression.hasSameText(other: FirExpression?): Boolean {
        val text = source?.text?.toString() ?: return false
        return text.filterNot(Char::isWhitespace).trim('(', ')') ==
            other?.source?.text?.toString()?.filterNot(Char::isWhitespace)?.trim('(', ')')
    }
}
