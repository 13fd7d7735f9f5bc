package org.collektive.compiler.alignment

import org.jetbrains.kotlin.backend.common.extensions.IrGenerationExtension
import org.jetbrains.kotlin.backend.common.extensions.IrPluginContext
import org.jetbrains.kotlin.ir.declarations.IrModuleFragment

/** Runs [AlignmentTransformer] on every file of a module that has the DSL on its class path. */
internal class AlignmentExtension : IrGenerationExtension {
    override fun generate(moduleFragment: IrModuleFragment, pluginContext: IrPluginContext) {
        for (file in moduleFragment.files) {
            val dsl = DslSymbols.find(pluginContext.finderForSource(file)) ?: continue
            val reach = AggregateReach(dsl)
            val tokens = Tokens(moduleFragment.name.asString(), file)
            file.transform(AlignmentTransformer(pluginContext, dsl, reach, tokens), null)
        }
    }
}
