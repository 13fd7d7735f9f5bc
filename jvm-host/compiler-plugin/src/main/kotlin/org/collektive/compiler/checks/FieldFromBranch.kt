package org.collektive.compiler.checks

import org.jetbrains.kotlin.diagnostics.DiagnosticReporter
import org.jetbrains.kotlin.diagnostics.KtDiagnosticFactory0
import org.jetbrains.kotlin.diagnostics.reportOn
import org.jetbrains.kotlin.fir.FirElement
import org.jetbrains.kotlin.fir.analysis.checkers.MppCheckerKind
import org.jetbrains.kotlin.fir.analysis.checkers.context.CheckerContext
import org.jetbrains.kotlin.fir.analysis.checkers.expression.FirExpressionChecker
import org.jetbrains.kotlin.fir.declarations.FirClass
import org.jetbrains.kotlin.fir.declarations.FirFunction
import org.jetbrains.kotlin.fir.declarations.FirVariable
import org.jetbrains.kotlin.fir.expressions.FirBlock
import org.jetbrains.kotlin.fir.expressions.FirBooleanOperatorExpression
import org.jetbrains.kotlin.fir.expressions.FirElvisExpression
import org.jetbrains.kotlin.fir.expressions.FirExpression
import org.jetbrains.kotlin.fir.expressions.FirPropertyAccessExpression
import org.jetbrains.kotlin.fir.expressions.FirResolvedQualifier
import org.jetbrains.kotlin.fir.expressions.FirReturnExpression
import org.jetbrains.kotlin.fir.expressions.FirStatement
import org.jetbrains.kotlin.fir.expressions.FirThisReceiverExpression
import org.jetbrains.kotlin.fir.expressions.FirTryExpression
import org.jetbrains.kotlin.fir.expressions.FirVariableAssignment
import org.jetbrains.kotlin.fir.expressions.FirWhenBranch
import org.jetbrains.kotlin.fir.expressions.FirWhenExpression
import org.jetbrains.kotlin.fir.expressions.unwrapLValue
import org.jetbrains.kotlin.fir.expressions.unwrapSmartcastExpression
import org.jetbrains.kotlin.fir.references.toResolvedVariableSymbol
import org.jetbrains.kotlin.fir.symbols.impl.FirLocalPropertySymbol
import org.jetbrains.kotlin.fir.symbols.impl.FirValueParameterSymbol
import org.jetbrains.kotlin.fir.types.resolvedType

/**
 * Reports fields that are the value of an `if` or `when`. Such a field lacks the neighbours in other arms, although they are aligned
 * again after the branch.
 */
internal object FieldFromBranch : FirExpressionChecker<FirWhenExpression>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirWhenExpression) {
        if (!isValueUsed(expression)) return
        for (branch in expression.branches) reportField(branch.result, AggregateDiagnostics.FIELD_FROM_BRANCH)
    }
}

/** Warns about a field from the right side of `?:`, which also contains only the neighbours that took this branch. */
internal object FieldFromElvis : FirExpressionChecker<FirElvisExpression>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirElvisExpression) {
        if (isValueUsed(expression)) reportField(expression.rhs, AggregateDiagnostics.FIELD_LEAVES_BRANCH)
    }
}

/** Warns about a field that leaves an arm by `return`. */
internal object FieldReturnedFromBranch : FirExpressionChecker<FirReturnExpression>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirReturnExpression) {
        val isOutside = { element: FirElement -> element === expression.target.labeledElement }
        if (isInArm(expression, isOutside) && isValueUsed(expression.result)) {
            reportField(expression.result, AggregateDiagnostics.FIELD_LEAVES_BRANCH)
        }
    }
}

/** Warns about a field that is assigned inside an arm to an outer variable, or to a property of an outer object. */
internal object FieldAssignedInBranch : FirExpressionChecker<FirVariableAssignment>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirVariableAssignment) {
        if (!expression.rValue.isField()) return
        val isOutside = expression.unwrapLValue()?.let(::declares) ?: return
        if (isInArm(expression, isOutside)) reportField(expression.rValue, AggregateDiagnostics.FIELD_LEAVES_BRANCH)
    }

    /** Returns a predicate for elements that declare the variable or object at the start of [read]; `null` if that is a call. */
    private fun declares(read: FirExpression): ((FirElement) -> Boolean)? {
        val start = read.unwrapSmartcastExpression()
        if (start is FirThisReceiverExpression) {
            val owner = start.calleeReference.boundSymbol
            return { it is FirClass && it.symbol == owner || it is FirFunction && it.receiverParameter?.symbol == owner }
        }
        if (start is FirResolvedQualifier) return { false }
        val variable = (start as? FirPropertyAccessExpression)?.calleeReference?.toResolvedVariableSymbol() ?: return null
        if (variable is FirLocalPropertySymbol || variable is FirValueParameterSymbol) {
            return { element -> element.contains { it is FirVariable && it.symbol == variable } }
        }
        val receiver = start.dispatchReceiver ?: start.extensionReceiver ?: return { false }
        return declares(receiver)
    }
}

/** Whether an arm encloses [statement], inside the innermost element for which [isOutside] holds. */
context(context: CheckerContext)
private fun isInArm(statement: FirStatement, isOutside: (FirElement) -> Boolean): Boolean {
    var inner: FirElement = statement
    for (element in context.containingElements.asReversed()) {
        if (isOutside(element)) return false
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

context(context: CheckerContext, reporter: DiagnosticReporter)
private fun reportField(result: FirStatement?, diagnostic: KtDiagnosticFactory0) {
    when (result) {
        // Their arms are checked separately.
        is FirWhenExpression, is FirElvisExpression -> Unit

        is FirBlock -> reportField(result.statements.lastOrNull(), diagnostic)

        is FirTryExpression -> {
            reportField(result.tryBlock, diagnostic)
            for (catch in result.catches) reportField(catch.block, diagnostic)
        }

        is FirExpression -> if (isAggregateCode() && result.isField()) reporter.reportOn(result.source, diagnostic)
    }
}

context(context: CheckerContext)
private fun FirExpression.isField(): Boolean = with(context.session) { resolvedType.isField() }
