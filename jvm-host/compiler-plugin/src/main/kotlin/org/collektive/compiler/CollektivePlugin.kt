@file:OptIn(ExperimentalCompilerApi::class)

package org.collektive.compiler

import org.collektive.compiler.alignment.AlignmentExtension
import org.collektive.compiler.checks.AggregateChecks
import org.collektive.compiler.programs.ProgramIndex
import org.jetbrains.kotlin.backend.common.extensions.IrGenerationExtension
import org.jetbrains.kotlin.compiler.plugin.CompilerPluginRegistrar
import org.jetbrains.kotlin.compiler.plugin.ExperimentalCompilerApi
import org.jetbrains.kotlin.config.CompilerConfiguration
import org.jetbrains.kotlin.config.JVMConfigurationKeys
import org.jetbrains.kotlin.fir.extensions.FirExtensionRegistrarAdapter

/** The plugin's entry point, which the compiler finds as a service. */
public class CollektivePlugin : CompilerPluginRegistrar() {
    override val pluginId: String get() = CollektiveOptions.PLUGIN_ID

    override val supportsK2: Boolean get() = true

    override fun ExtensionStorage.registerExtensions(configuration: CompilerConfiguration) {
        if (!configuration.get(CollektiveOptions.ENABLED, true)) return
        FirExtensionRegistrarAdapter.registerExtension(AggregateChecks())
        IrGenerationExtension.registerExtension(AlignmentExtension())
        // A compiler that writes a jar directly has no output folder, and its jar gets no index.
        configuration.get(JVMConfigurationKeys.OUTPUT_DIRECTORY)?.let { IrGenerationExtension.registerExtension(ProgramIndex(it)) }
    }
}
