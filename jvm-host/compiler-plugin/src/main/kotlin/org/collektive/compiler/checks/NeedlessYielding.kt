package org.collektive.compiler.checks

import org.collektive.compiler.names.DslNames
import org.jetbrains.kotlin.diagnostics.DiagnosticReporter
import org.jetbrains.kotlin.diagnostics.reportOn
import org.jetbrains.kotlin.fir.analysis.checkers.MppCheckerKind
import org.jetbrains.kotlin.fir.analysis.checkers.context.CheckerContext
import org.jetbrains.kotlin.fir.analysis.checkers.expression.FirExpressionChecker
import org.jetbrains.kotlin.fir.expressions.FirFunctionCall
import org.jetbrains.kotlin.fir.expressions.FirThisReceiverExpression

/** Reports `x.yielding { this }` and `x.yielding { x }`: they return the value that they store, as the simpler primitive does. */
internal object NeedlessYielding : FirExpressionChecker<FirFunctionCall>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirFunctionCall) {
        if (expression.callee?.callableId?.classId != DslNames.yieldingContext ||
            expression.calleeReference.name != DslNames.yielding
        ) {
            return
        }
        val lambda = expression.lambda ?: return
        val returned = lambda.onlyExpression ?: return
        val kept = expression.extensionReceiver?.readVariable
        val isSame = returned is FirThisReceiverExpression &&
            returned.calleeReference.boundSymbol == lambda.receiverParameter?.symbol ||
            kept != null && returned.readVariable == kept
        if (isSame && isAggregateCode()) reporter.reportOn(expression.source, AggregateDiagnostics.NEEDLESS_YIELDING)
    }
}
