package org.collektive.compiler.checks

import org.jetbrains.kotlin.diagnostics.DiagnosticReporter
import org.jetbrains.kotlin.diagnostics.reportOn
import org.jetbrains.kotlin.fir.analysis.checkers.MppCheckerKind
import org.jetbrains.kotlin.fir.analysis.checkers.context.CheckerContext
import org.jetbrains.kotlin.fir.analysis.checkers.expression.FirExpressionChecker
import org.jetbrains.kotlin.fir.expressions.FirFunctionCall
import org.jetbrains.kotlin.fir.expressions.arguments

/** Reports `evolve(init) { old -> ... neighboring(old) ... }`: it sends each value one round later than `share` does. */
internal object EvolveThatShares : FirExpressionChecker<FirFunctionCall>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirFunctionCall) {
        if (!expression.isAnyOf(setOf("evolve", "evolving"))) return
        val old = expression.lambda?.valueParameters?.singleOrNull()?.symbol ?: return
        val shares = expression.lambda?.body?.contains { inner ->
            inner is FirFunctionCall && inner.isAnyOf(setOf("neighboring")) && inner.arguments.firstOrNull()?.readVariable == old
        }
        if (shares == true && isAggregateCode()) reporter.reportOn(expression.source, AggregateDiagnostics.EVOLVE_THAT_SHARES)
    }
}
