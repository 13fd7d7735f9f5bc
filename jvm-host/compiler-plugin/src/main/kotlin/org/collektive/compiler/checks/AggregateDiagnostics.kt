package org.collektive.compiler.checks

import org.jetbrains.kotlin.com.intellij.psi.PsiElement
import org.jetbrains.kotlin.diagnostics.KtDiagnosticFactoryToRendererMap
import org.jetbrains.kotlin.diagnostics.KtDiagnosticsContainer
import org.jetbrains.kotlin.diagnostics.error0
import org.jetbrains.kotlin.diagnostics.rendering.BaseDiagnosticRendererFactory
import org.jetbrains.kotlin.diagnostics.rendering.CommonRenderers
import org.jetbrains.kotlin.diagnostics.warning0
import org.jetbrains.kotlin.diagnostics.warning1

/** What the checks report; a name here is also what `@Suppress` takes. */
internal object AggregateDiagnostics : KtDiagnosticsContainer() {
    val FIELD_FROM_BRANCH by error0<PsiElement>()
    val AGGREGATE_CALL_IN_LOOP by warning1<PsiElement, String>()
    val MANUAL_ALIGNMENT by warning1<PsiElement, String>()

    override fun getRendererFactory(): BaseDiagnosticRendererFactory = Texts

    private object Texts : BaseDiagnosticRendererFactory() {
        override val MAP by KtDiagnosticFactoryToRendererMap("Collektive") { map ->
            map.put(
                FIELD_FROM_BRANCH,
                "This branch returns a Field, which holds only the neighbours that chose the same branch. " +
                    "Choose between values: collapse the field inside the branch, or make it before.",
            )
            map.put(
                AGGREGATE_CALL_IN_LOOP,
                "''{0}'' runs several times at one place of the program, so its second run clashes with the first. " +
                    "Wrap the body in alignedOn(key) '{' ... '}' with a key of each iteration.",
                CommonRenderers.STRING,
            )
            map.put(
                MANUAL_ALIGNMENT,
                "The compiler aligns calls itself; ''{0}'' by hand can leave the program misaligned. Use alignedOn(pivot) '{' ... '}'.",
                CommonRenderers.STRING,
            )
        }
    }
}
