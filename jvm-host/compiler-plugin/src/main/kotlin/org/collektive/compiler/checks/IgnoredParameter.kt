package org.collektive.compiler.checks

import org.jetbrains.kotlin.diagnostics.DiagnosticReporter
import org.jetbrains.kotlin.diagnostics.reportOn
import org.jetbrains.kotlin.fir.analysis.checkers.MppCheckerKind
import org.jetbrains.kotlin.fir.analysis.checkers.context.CheckerContext
import org.jetbrains.kotlin.fir.analysis.checkers.expression.FirExpressionChecker
import org.jetbrains.kotlin.fir.expressions.FirExpression
import org.jetbrains.kotlin.fir.expressions.FirFunctionCall

/** Reports a primitive whose lambda ignores its parameter, if a simpler expression can replace the call. */
internal object IgnoredParameter : FirExpressionChecker<FirFunctionCall>(MppCheckerKind.Common) {
    private val simpler = mapOf(
        "evolve" to "the value itself",
        "evolving" to "the value itself",
        "share" to "neighboring",
        "sharing" to "neighboring",
        "exchange" to "neighboring",
        "exchanging" to "neighboring",
    )

    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirFunctionCall) {
        if (!expression.isAnyOf(simpler.keys)) return
        val lambda = expression.lambda ?: return
        val given = lambda.valueParameters.singleOrNull()?.symbol ?: return
        if (lambda.body?.contains { it is FirExpression && it.readVariable == given } != false || !isAggregateCode()) return
        val name = expression.calleeReference.name.asString()
        reporter.reportOn(expression.source, AggregateDiagnostics.IGNORED_PARAMETER, name, simpler.getValue(name))
    }
}
