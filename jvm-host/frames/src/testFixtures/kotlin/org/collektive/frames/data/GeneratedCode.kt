package org.collektive.frames.data

import org.jetbrains.kotlin.cli.common.ExitCode
import org.jetbrains.kotlin.cli.common.arguments.K2JVMCompilerArguments
import org.jetbrains.kotlin.cli.common.messages.MessageRenderer
import org.jetbrains.kotlin.cli.common.messages.PrintingMessageCollector
import org.jetbrains.kotlin.cli.jvm.K2JVMCompiler
import org.jetbrains.kotlin.config.Services
import java.io.File
import java.nio.file.Path
import javax.tools.ToolProvider
import kotlin.io.path.ExperimentalPathApi
import kotlin.io.path.copyToRecursively
import kotlin.io.path.createDirectories
import kotlin.io.path.exists
import kotlin.io.path.extension
import kotlin.io.path.walk
import org.collektive.generator.main as generate

/** Generates and compiles code of schemas as a user's build does: flatc's Java, then Kotlin. Warnings are errors. */
@OptIn(ExperimentalPathApi::class)
internal object GeneratedCode {
    private val root = Path.of(System.getProperty("collektive.root"))

    /** Generates the code of [schema] into [folder]. */
    fun generate(schema: Path, folder: Path) {
        val flatc = System.getProperty("collektive.flatc")
        generate(
            arrayOf(
                "--flatc",
                flatc,
                "--schema",
                "$schema",
                "--include",
                "${root.resolve("schema")}",
                "--jvm",
                "${folder.createDirectories()}",
            ),
        )
    }

    /** Compiles the generated code in [folder] into [classes], and copies its resources. */
    fun compile(folder: Path, classes: Path) {
        javac(listOf(folder), classes, "-Xlint:all", "-Werror")
        val arguments = K2JVMCompilerArguments().apply {
            freeArgs = listOf("$folder")
            destination = "$classes"
            classpath = classPath(classes)
            noStdlib = true
            noReflect = true
            jvmTarget = "17"
            explicitApi = "strict"
            allWarningsAsErrors = true
            moduleName = "generated"
        }
        val messages = PrintingMessageCollector(System.err, MessageRenderer.PLAIN_FULL_PATHS, false)
        check(K2JVMCompiler().exec(messages, Services.EMPTY, arguments) == ExitCode.OK) { "the Kotlin compiler failed" }
        val resources = folder.resolve("META-INF")
        if (resources.exists()) resources.copyToRecursively(classes.resolve("META-INF"), followLinks = false, overwrite = true)
    }

    /** Compiles the Java in [folders] into [classes], which it may use. */
    fun javac(folders: List<Path>, classes: Path, vararg options: String) {
        val files = folders.flatMap { it.walk().filter { file -> file.extension == "java" } }.map(Path::toString)
        val common = listOf("-d", "$classes", "-cp", classPath(classes), "-proc:none")
        val code = ToolProvider.getSystemJavaCompiler().run(null, null, null, *(common + options + files).toTypedArray())
        check(code == 0) { "javac failed" }
    }

    private fun classPath(classes: Path) = System.getProperty("java.class.path") + File.pathSeparator + classes
}
