@file:OptIn(ExperimentalCompilerApi::class)

package org.collektive.compiler

import org.jetbrains.kotlin.compiler.plugin.AbstractCliOption
import org.jetbrains.kotlin.compiler.plugin.CliOption
import org.jetbrains.kotlin.compiler.plugin.CliOptionProcessingException
import org.jetbrains.kotlin.compiler.plugin.CommandLineProcessor
import org.jetbrains.kotlin.compiler.plugin.ExperimentalCompilerApi
import org.jetbrains.kotlin.config.CompilerConfiguration
import org.jetbrains.kotlin.config.CompilerConfigurationKey

/** The plugin's command line: `-P plugin:it.unibo.collektive.collektive-compiler-plugin:collektiveEnabled=true|false`. */
public class CollektiveOptions : CommandLineProcessor {
    override val pluginId: String get() = PLUGIN_ID

    override val pluginOptions: Collection<AbstractCliOption> get() = listOf(enabled)

    override fun processOption(option: AbstractCliOption, value: String, configuration: CompilerConfiguration) {
        val isEnabled = value.toBooleanStrictOrNull()
            ?: throw CliOptionProcessingException("${option.optionName} is '$value'; it must be true or false")
        configuration.put(ENABLED, isEnabled)
    }

    internal companion object {
        const val PLUGIN_ID = "it.unibo.collektive.collektive-compiler-plugin"

        val ENABLED = CompilerConfigurationKey<Boolean>("align and check aggregate programs")

        private val enabled = CliOption(
            optionName = "collektiveEnabled",
            valueDescription = "<true|false>",
            description = "whether to align and check aggregate programs (default: true)",
            required = false,
        )
    }
}
