package org.collektive.compiler.checks

import org.jetbrains.kotlin.com.intellij.psi.PsiElement
import org.jetbrains.kotlin.diagnostics.KtDiagnosticFactoryToRendererMap
import org.jetbrains.kotlin.diagnostics.KtDiagnosticsContainer
import org.jetbrains.kotlin.diagnostics.error0
import org.jetbrains.kotlin.diagnostics.rendering.BaseDiagnosticRendererFactory
import org.jetbrains.kotlin.diagnostics.rendering.CommonRenderers
import org.jetbrains.kotlin.diagnostics.warning0
import org.jetbrains.kotlin.diagnostics.warning1
import org.jetbrains.kotlin.diagnostics.warning2

/** The diagnostics of the checks, with their conditions and fixes. `@Suppress` accepts their names. */
internal object AggregateDiagnostics : KtDiagnosticsContainer() {
    /**
     * A `Field` is the value of an arm of `if` or `when`.
     * Collapse it inside the arm, or create it before the branch.
     */
    val FIELD_FROM_BRANCH by error0<PsiElement>()

    /** A `Field` leaves an arm by `?:`, by `return` or by assignment to an outer variable or property. Fix it like [FIELD_FROM_BRANCH]. */
    val FIELD_LEAVES_BRANCH by warning0<PsiElement>()

    /**
     * An aggregate call is in a loop or a collection's lambda without `alignedOn`.
     * Wrap the body in `alignedOn(key)`, with a key that differs in each iteration.
     */
    val AGGREGATE_CALL_IN_LOOP by warning1<PsiElement, String>()

    /** `align` or `dealign` is called by hand. Use `alignedOn`. */
    val MANUAL_ALIGNMENT by warning1<PsiElement, String>()

    /** `evolve` sends its old value with `neighboring`. Use `share`, which sends each value one round earlier. */
    val EVOLVE_THAT_SHARES by warning0<PsiElement>()

    /** The lambda of a primitive ignores its parameter. Use the simpler expression that the message names. */
    val IGNORED_PARAMETER by warning2<PsiElement, String, String>()

    /** `yielding` returns the value that is stored. Use the variant without it. */
    val NEEDLESS_YIELDING by warning0<PsiElement>()

    /** `neighboring` sends a literal. Use `neighborhood()` or `mapNeighborhood`. */
    val CONSTANT_NEIGHBORING by warning0<PsiElement>()

    override fun getRendererFactory(): BaseDiagnosticRendererFactory = Texts

    private object Texts : BaseDiagnosticRendererFactory() {
        @Suppress("ktlint:standard:property-naming") // The compiler prescribes this name.
        override val MAP by KtDiagnosticFactoryToRendererMap("Collektive") { map ->
            for (diagnostic in listOf(FIELD_FROM_BRANCH, FIELD_LEAVES_BRANCH)) {
                map.put(
                    diagnostic,
                    "This Field leaves its branch, but contains only the neighbours that took the same branch. " +
                        "Collapse the field inside the branch, or create it before the branch.",
                )
            }
            map.put(
                AGGREGATE_CALL_IN_LOOP,
                "''{0}'' runs several times at the same path, so its second run clashes with the first. " +
                    "Wrap the body in alignedOn(key) '{' ... '}' with a different key in each iteration.",
                CommonRenderers.STRING,
            )
            map.put(
                MANUAL_ALIGNMENT,
                "The compiler plugin already aligns calls, and ''{0}'' can leave the program misaligned. Use alignedOn(pivot) '{' ... '}'.",
                CommonRenderers.STRING,
            )
            map.put(
                EVOLVE_THAT_SHARES,
                "This sends the value of the previous round. Use 'share', which sends the new value, so information travels twice as fast.",
            )
            map.put(
                IGNORED_PARAMETER,
                "The lambda of ''{0}'' ignores its parameter. Use {1} instead.",
                CommonRenderers.STRING,
                CommonRenderers.STRING,
            )
            map.put(
                NEEDLESS_YIELDING,
                "This returns the value that it stores. Use the variant without 'yielding' (evolve, share or exchange).",
            )
            map.put(
                CONSTANT_NEIGHBORING,
                "Every device sends the same constant. Use neighborhood() or mapNeighborhood { ... }, which send no values.",
            )
        }
    }
}
