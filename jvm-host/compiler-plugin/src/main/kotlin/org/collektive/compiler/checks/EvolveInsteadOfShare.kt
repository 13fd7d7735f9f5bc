package org.collektive.compiler.checks

import org.jetbrains.kotlin.diagnostics.DiagnosticReporter
import org.jetbrains.kotlin.diagnostics.reportOn
import org.jetbrains.kotlin.fir.analysis.checkers.MppCheckerKind
import org.jetbrains.kotlin.fir.analysis.checkers.context.CheckerContext
import org.jetbrains.kotlin.fir.analysis.checkers.expression.FirExpressionChecker
import org.jetbrains.kotlin.fir.declarations.FirProperty
import org.jetbrains.kotlin.fir.expressions.FirFunctionCall
import org.jetbrains.kotlin.fir.expressions.arguments
import org.jetbrains.kotlin.fir.symbols.impl.FirVariableSymbol

/**
 * Reports `evolve(init) { old -> ... neighboring(old) ... }`, also through local `val`s. This sends each value one round later than `share`
 * does.
 */
internal object EvolveInsteadOfShare : FirExpressionChecker<FirFunctionCall>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirFunctionCall) {
        if (!expression.isAnyOf(setOf("evolve", "evolving"))) return
        val lambda = expression.lambda ?: return
        val old = lambda.valueParameters.singleOrNull()?.symbol ?: return
        val copies = hashSetOf<FirVariableSymbol<*>>(old)
        val shares = lambda.body?.contains { inner ->
            if (inner is FirProperty && inner.isVal && inner.initializer?.readVariable in copies) copies += inner.symbol
            inner is FirFunctionCall && inner.isAnyOf(setOf("neighboring")) && inner.arguments.firstOrNull()?.readVariable in copies
        }
        if (shares == true && isAggregateCode()) reporter.reportOn(expression.source, AggregateDiagnostics.EVOLVE_THAT_SHARES)
    }
}
