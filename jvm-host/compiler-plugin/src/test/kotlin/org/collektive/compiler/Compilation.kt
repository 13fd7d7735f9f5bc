@file:OptIn(ExperimentalCompilerApi::class)

package org.collektive.compiler

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.ints.FieldedInts
import it.unibo.collektive.stdlib.util.Point2D
import kotlinx.serialization.KSerializer
import org.collektive.api.Program
import org.jetbrains.kotlin.cli.common.ExitCode
import org.jetbrains.kotlin.cli.common.arguments.K2JVMCompilerArguments
import org.jetbrains.kotlin.cli.common.messages.CompilerMessageSeverity
import org.jetbrains.kotlin.cli.common.messages.CompilerMessageSourceLocation
import org.jetbrains.kotlin.cli.common.messages.MessageCollector
import org.jetbrains.kotlin.cli.jvm.K2JVMCompiler
import org.jetbrains.kotlin.compiler.plugin.CompilerPluginRegistrar
import org.jetbrains.kotlin.compiler.plugin.ExperimentalCompilerApi
import org.jetbrains.kotlin.config.Services
import org.jetbrains.kotlinx.serialization.compiler.extensions.SerializationComponentRegistrar
import java.io.File
import java.lang.reflect.InvocationTargetException
import java.net.URLClassLoader
import java.nio.file.Files
import java.nio.file.Path

/** One line of the compiler's output. */
internal data class Report(val severity: CompilerMessageSeverity, val line: Int, val text: String) {
    /** The name of the diagnostic: `FIELD_FROM_BRANCH` for `[FIELD_FROM_BRANCH] ...`. */
    val name: String get() = text.substringAfter('[', "").substringBefore(']')
}

/** A Kotlin source that the real compiler has compiled with the plugin. */
internal class Compilation private constructor(val succeeded: Boolean, val reports: List<Report>, private val classes: Path) {
    private val loader by lazy { URLClassLoader(arrayOf(classes.toUri().toURL()), javaClass.classLoader) }

    /**
     * Returns a top-level function of the source as a program.
     *
     * [name] begins with the package of the source if it has one. [arguments] are passed after the receiver.
     */
    fun program(name: String, vararg arguments: Any?): Aggregate<Int>.() -> Any? {
        check(succeeded) { "the source does not compile: $reports" }
        val method = loader.loadClass(name.replaceAfterLast('.', "${FILE}Kt", "${FILE}Kt")).methods.single {
            it.name ==
                name.substringAfterLast('.')
        }
        return {
            try {
                method.invoke(null, this, *arguments)
            } catch (e: InvocationTargetException) {
                throw e.targetException
            }
        }
    }

    /** Returns the text of the file [path] among the compiled classes, or `null`. */
    fun output(path: String): String? = classes.resolve(path).toFile().takeIf(File::exists)?.readText()

    companion object {
        const val FILE = "Program"

        private const val IMPORTS = "import it.unibo.collektive.aggregate.*; import it.unibo.collektive.aggregate.api.*;"

        /** Compiles [source] with imports of all names of the DSL. Reports contain the line numbers of [source]. */
        fun of(source: String, vararg options: String, module: String = "programs"): Compilation {
            val folder = Files.createTempDirectory("compilation")
            Runtime.getRuntime().addShutdownHook(Thread { folder.toFile().deleteRecursively() })
            val text = source.trimIndent()
            // Imports must follow a file annotation or a package. They are added to the first line, so the line numbers stay the same.
            val firstCode = if (text.startsWith("@file:") || text.startsWith("package ")) text.indexOf('\n') else 0
            val file = folder.resolve("$FILE.kt").toFile()
            file.writeText(text.substring(0, firstCode) + " " + IMPORTS + text.substring(firstCode))
            val reports = mutableListOf<Report>()
            val arguments = K2JVMCompilerArguments().apply {
                freeArgs = listOf(file.path)
                destination = folder.resolve("classes").toString()
                classpath =
                    listOf(
                        Aggregate::class,
                        Point2D::class,
                        FieldedInts::class,
                        Program::class,
                        KSerializer::class,
                        Unit::class,
                    ).joinToString(File.pathSeparator) {
                        placeOf(it.java)
                    }
                noStdlib = true
                noReflect = true
                moduleName = module
                jvmTarget = "17"
                renderInternalDiagnosticNames = true
                reportAllWarnings = true
                verifyIr = "error"
                optIn = arrayOf("it.unibo.collektive.aggregate.api.DelicateCollektiveApi")
                pluginClasspaths = PLUGIN + placeOf(SerializationComponentRegistrar::class.java)
                pluginOptions = options.map { "plugin:${CollektiveOptions.PLUGIN_ID}:$it" }.toTypedArray()
            }
            val code = K2JVMCompiler().exec(Collector(reports), Services.EMPTY, arguments)
            return Compilation(code == ExitCode.OK, reports.sortedBy { it.line }, folder.resolve("classes"))
        }

        /** The folders or jars of the plugin's classes and its services. Some builds write these to two folders. */
        private val PLUGIN: Array<String> = CompilerPluginRegistrar::class.java.name.let { service ->
            val services = CollektivePlugin::class.java.classLoader.getResources("META-INF/services/$service").asSequence()
                .filter { it.protocol == "file" }
                .map { File(it.toURI()).resolve("../../..").canonicalPath }
            (services + placeOf(CollektivePlugin::class.java)).distinct().toList().toTypedArray()
        }

        /** Returns the jar or folder from which [type] was loaded. */
        private fun placeOf(type: Class<*>): String = File(type.protectionDomain.codeSource.location.toURI()).path
    }

    private class Collector(private val reports: MutableList<Report>) : MessageCollector {
        override fun clear() = reports.clear()

        override fun hasErrors() = reports.any { it.severity.isError }

        override fun report(severity: CompilerMessageSeverity, message: String, location: CompilerMessageSourceLocation?) {
            if (severity.isError || severity.isWarning) reports += Report(severity, location?.line ?: 0, message)
        }
    }
}
