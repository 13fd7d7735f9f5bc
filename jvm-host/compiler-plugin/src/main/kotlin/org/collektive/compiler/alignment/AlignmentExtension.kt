package org.collektive.compiler.alignment

import org.jetbrains.kotlin.backend.common.extensions.IrGenerationExtension
import org.jetbrains.kotlin.backend.common.extensions.IrPluginContext
import org.jetbrains.kotlin.ir.IrElement
import org.jetbrains.kotlin.ir.declarations.IrClass
import org.jetbrains.kotlin.ir.declarations.IrModuleFragment
import org.jetbrains.kotlin.ir.visitors.IrVisitorVoid
import org.jetbrains.kotlin.ir.visitors.acceptChildrenVoid

/** Runs [AlignmentTransformer] on every file of a module that has the DSL on its class path. */
internal class AlignmentExtension : IrGenerationExtension {
    override fun generate(moduleFragment: IrModuleFragment, pluginContext: IrPluginContext) {
        val classes = classesIn(moduleFragment)
        for (file in moduleFragment.files) {
            val dsl = DslSymbols.find(pluginContext.finderForSource(file), classes) ?: continue
            val reach = AggregateReach(dsl)
            val tokens = Tokens(moduleFragment.name.asString(), file)
            file.transform(AlignmentTransformer(pluginContext, dsl, reach, tokens), null)
        }
    }

    private fun classesIn(module: IrModuleFragment): List<IrClass> {
        val classes = ArrayList<IrClass>()
        module.acceptChildrenVoid(object : IrVisitorVoid() {
            override fun visitElement(element: IrElement) {
                if (element is IrClass) classes += element
                element.acceptChildrenVoid(this)
            }
        })
        return classes
    }
}
