package org.collektive.compiler.checks

import org.jetbrains.kotlin.diagnostics.DiagnosticReporter
import org.jetbrains.kotlin.diagnostics.reportOn
import org.jetbrains.kotlin.fir.FirElement
import org.jetbrains.kotlin.fir.analysis.checkers.MppCheckerKind
import org.jetbrains.kotlin.fir.analysis.checkers.context.CheckerContext
import org.jetbrains.kotlin.fir.analysis.checkers.expression.FirExpressionChecker
import org.jetbrains.kotlin.fir.declarations.FirFunction
import org.jetbrains.kotlin.fir.expressions.FirBlock
import org.jetbrains.kotlin.fir.expressions.FirBooleanOperatorExpression
import org.jetbrains.kotlin.fir.expressions.FirElvisExpression
import org.jetbrains.kotlin.fir.expressions.FirExpression
import org.jetbrains.kotlin.fir.expressions.FirReturnExpression
import org.jetbrains.kotlin.fir.expressions.FirStatement
import org.jetbrains.kotlin.fir.expressions.FirWhenBranch
import org.jetbrains.kotlin.fir.expressions.FirWhenExpression
import org.jetbrains.kotlin.fir.types.resolvedType

/** Fields must not leave `if` and `when`: outside, devices that chose other arms are aligned too. */
internal object FieldFromBranch : FirExpressionChecker<FirWhenExpression>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirWhenExpression) {
        if (!expression.usedAsExpression) return
        for (branch in expression.branches) reportField(branch.result.statements.lastOrNull())
    }
}

/** The same for `?:`. */
internal object FieldFromElvis : FirExpressionChecker<FirElvisExpression>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirElvisExpression) {
        if (!isStatement(expression)) reportField(expression.rhs)
    }

    /** Whether nobody takes the result. */
    context(context: CheckerContext)
    private fun isStatement(expression: FirElvisExpression): Boolean {
        val (owner, block) = context.containingElements.takeWhile { it !== expression }.takeLast(2).takeIf { it.size == 2 } ?: return false
        return block is FirBlock && (owner is FirFunction || block.statements.last() !== expression)
    }
}

/** The same for a `return` inside an arm, by which the arm's field leaves the function. */
internal object FieldReturnedFromBranch : FirExpressionChecker<FirReturnExpression>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirReturnExpression) {
        if (isInArm(expression)) reportField(expression.result)
    }

    /** Whether there is an arm between [expression] and the function that it ends. */
    context(context: CheckerContext)
    private fun isInArm(expression: FirReturnExpression): Boolean {
        var inner: FirElement = expression
        for (element in context.containingElements.asReversed()) {
            if (element === expression.target.labeledElement) return false
            val isArm = when (element) {
                is FirWhenBranch -> element.result === inner
                is FirElvisExpression -> element.rhs === inner
                is FirBooleanOperatorExpression -> element.rightOperand === inner
                else -> false
            }
            if (isArm) return true
            inner = element
        }
        return false
    }
}

context(context: CheckerContext, reporter: DiagnosticReporter)
private fun reportField(result: FirStatement?) {
    when {
        // Their own arms are checked.
        result is FirWhenExpression || result is FirElvisExpression -> Unit
        result is FirBlock -> reportField(result.statements.lastOrNull())
        result !is FirExpression || !isAggregateCode() -> Unit
        with(context.session) { result.resolvedType.isField() } ->
            reporter.reportOn(result.source, AggregateDiagnostics.FIELD_FROM_BRANCH)
    }
}
