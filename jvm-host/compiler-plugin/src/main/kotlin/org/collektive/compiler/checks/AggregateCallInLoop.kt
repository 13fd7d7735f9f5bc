package org.collektive.compiler.checks

import org.collektive.compiler.names.DslNames
import org.jetbrains.kotlin.diagnostics.DiagnosticReporter
import org.jetbrains.kotlin.diagnostics.reportOn
import org.jetbrains.kotlin.fir.analysis.checkers.MppCheckerKind
import org.jetbrains.kotlin.fir.analysis.checkers.context.CheckerContext
import org.jetbrains.kotlin.fir.analysis.checkers.expression.FirExpressionChecker
import org.jetbrains.kotlin.fir.declarations.FirAnonymousFunction
import org.jetbrains.kotlin.fir.declarations.FirClass
import org.jetbrains.kotlin.fir.declarations.FirFunction
import org.jetbrains.kotlin.fir.expressions.FirFunctionCall
import org.jetbrains.kotlin.fir.expressions.FirLoop
import org.jetbrains.kotlin.fir.expressions.FirPropertyAccessExpression
import org.jetbrains.kotlin.fir.expressions.FirQualifiedAccessExpression
import org.jetbrains.kotlin.fir.expressions.arguments
import org.jetbrains.kotlin.fir.references.toResolvedCallableSymbol
import org.jetbrains.kotlin.fir.types.coneType
import org.jetbrains.kotlin.fir.types.resolvedType

/** Reports an aggregate call or getter that runs several times at the same path, in a loop or in a lambda that runs for each element. */
internal object AggregateCallInLoop : FirExpressionChecker<FirQualifiedAccessExpression>(MppCheckerKind.Common) {
    context(context: CheckerContext, reporter: DiagnosticReporter)
    override fun check(expression: FirQualifiedAccessExpression) {
        if (!isAggregateCall(expression) || !isAggregateCode() || !repeats(expression)) return
        val name = expression.calleeReference.toResolvedCallableSymbol()?.name ?: return
        reporter.reportOn(expression.source, AggregateDiagnostics.AGGREGATE_CALL_IN_LOOP, name.asString())
    }

    /** Visits the enclosing elements from the inside out, until one determines whether [expression] runs once or several times per path. */
    context(context: CheckerContext)
    private fun repeats(expression: FirQualifiedAccessExpression): Boolean {
        var lambda: FirAnonymousFunction? = null
        for (element in context.containingElements.asReversed()) {
            when (element) {
                expression -> Unit

                is FirLoop -> return true

                // The lambda is a separate program, for example in a test that runs a program per device.
                is FirAnonymousFunction -> if (givesAggregate(element)) return false else lambda = element

                is FirFunction, is FirClass -> return false

                is FirFunctionCall -> {
                    if (lambda == null || element.parameterOf(lambda) == null) continue
                    when {
                        isAlignedOn(element) -> return false

                        isPerElement(element) -> return true

                        // The outer call is reported instead.
                        isAggregateCall(element) -> return false
                    }
                    lambda = null
                }
            }
        }
        return false
    }

    context(context: CheckerContext)
    private fun givesAggregate(lambda: FirAnonymousFunction): Boolean = with(context.session) {
        val types = listOfNotNull(lambda.receiverParameter?.typeRef) + lambda.contextParameters.map { it.returnTypeRef } +
            lambda.valueParameters.map { it.returnTypeRef }
        types.any { it.coneType.isAggregate() }
    }

    private fun isAlignedOn(call: FirFunctionCall) = call.callee?.isDsl(DslNames.alignedOn) == true

    /** Whether an Aggregate is passed to [call]. Excludes `align`, `dealign`, `alignedOn` and the properties of Aggregate. */
    context(context: CheckerContext)
    private fun isAggregateCall(call: FirQualifiedAccessExpression): Boolean = with(context.session) {
        val given = listOfNotNull(call.extensionReceiver) + call.contextArguments + when (call) {
            is FirFunctionCall -> {
                val callee = call.callee ?: return false
                if (callee.isDsl(DslNames.align) || callee.isDsl(DslNames.dealign) || isAlignedOn(call)) return false
                listOfNotNull(call.dispatchReceiver) + call.arguments
            }

            is FirPropertyAccessExpression -> emptyList()

            else -> return false
        }
        given.any { it.resolvedType.isAggregate() }
    }

    private fun isPerElement(call: FirFunctionCall): Boolean {
        val callee = call.callee?.callableId ?: return false
        val name = callee.callableName.asString()
        return when (callee.packageName.asString()) {
            "kotlin" -> name == "repeat"
            in COLLECTIONS -> name !in AT_MOST_ONCE
            else -> false
        }
    }

    private val COLLECTIONS = setOf(
        "kotlin.collections",
        "kotlin.sequences",
        "kotlin.text",
        "java.lang",
        "java.util",
        "java.util.stream",
        "it.unibo.collektive.stdlib.collapse",
    )

    private val AT_MOST_ONCE = setOf(
        "buildList", "buildMap", "buildSet", "buildString", "elementAtOrElse", "getOrElse", "getOrPut", "ifBlank", "ifEmpty",
        "computeIfAbsent", "computeIfPresent", "compute", "merge", "iterator", "sequence",
    )
}
