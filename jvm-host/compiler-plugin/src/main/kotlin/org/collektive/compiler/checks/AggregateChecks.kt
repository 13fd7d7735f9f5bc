package org.collektive.compiler.checks

import org.jetbrains.kotlin.fir.FirSession
import org.jetbrains.kotlin.fir.analysis.checkers.expression.ExpressionCheckers
import org.jetbrains.kotlin.fir.analysis.extensions.FirAdditionalCheckersExtension
import org.jetbrains.kotlin.fir.extensions.FirExtensionRegistrar

/** Registers all checks of aggregate programs. */
internal class AggregateChecks : FirExtensionRegistrar() {
    override fun ExtensionRegistrarContext.configurePlugin() {
        +::Checkers
        registerDiagnosticContainers(AggregateDiagnostics)
    }

    private class Checkers(session: FirSession) : FirAdditionalCheckersExtension(session) {
        override val expressionCheckers = object : ExpressionCheckers() {
            override val whenExpressionCheckers = setOf(FieldFromBranch)
            override val elvisExpressionCheckers = setOf(FieldFromElvis)
            override val returnExpressionCheckers = setOf(FieldReturnedFromBranch)
            override val variableAssignmentCheckers = setOf(FieldAssignedInBranch)
            override val qualifiedAccessExpressionCheckers = setOf(AggregateCallInLoop)
            override val functionCallCheckers =
                setOf(ManualAlignment, EvolveInsteadOfShare, IgnoredParameter, NeedlessYielding, ConstantNeighboring)
        }
    }
}
