package org.collektive.compiler.checks

import org.collektive.compiler.names.DslNames
import org.jetbrains.kotlin.diagnostics.DiagnosticReporter
import org.jetbrains.kotlin.diagnostics.reportOn
import org.jetbrains.kotlin.fir.analysis.checkers.MppCheckerKind
import org.jetbrains.kotlin.fir.analysis.checkers.context.CheckerContext
import org.jetbrains.kotlin.fir.analysis.checkers.expression.FirExpressionChecker
import org.jetbrains.kotlin.fir.expressions.FirFunctionCall

/** Reports `align` and `dealign` in a program. */
internal object ManualAlignment : FirExpressionChecker<FirFunctionCall>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirFunctionCall) {
        val callee = expression.callee ?: return
        val name = listOf(DslNames.align, DslNames.dealign).firstOrNull(callee::isDsl) ?: return
        if (isAggregateCode()) reporter.reportOn(expression.source, AggregateDiagnostics.MANUAL_ALIGNMENT, name.asString())
    }
}
