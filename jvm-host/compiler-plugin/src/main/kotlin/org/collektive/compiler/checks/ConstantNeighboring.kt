package org.collektive.compiler.checks

import org.collektive.compiler.names.DslNames
import org.jetbrains.kotlin.diagnostics.DiagnosticReporter
import org.jetbrains.kotlin.diagnostics.reportOn
import org.jetbrains.kotlin.fir.analysis.checkers.MppCheckerKind
import org.jetbrains.kotlin.fir.analysis.checkers.context.CheckerContext
import org.jetbrains.kotlin.fir.analysis.checkers.expression.FirExpressionChecker
import org.jetbrains.kotlin.fir.expressions.FirFunctionCall
import org.jetbrains.kotlin.fir.expressions.FirLiteralExpression
import org.jetbrains.kotlin.fir.expressions.arguments
import org.jetbrains.kotlin.fir.expressions.unwrapArgument

/** Reports `neighboring(1)`: every device sends the same constant, which receivers already know. */
internal object ConstantNeighboring : FirExpressionChecker<FirFunctionCall>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirFunctionCall) {
        if (expression.callee?.isDsl(DslNames.neighboring) != true) return
        if (expression.arguments.firstOrNull()?.unwrapArgument() !is FirLiteralExpression || !isAggregateCode()) return
        reporter.reportOn(expression.source, AggregateDiagnostics.CONSTANT_NEIGHBORING)
    }
}
