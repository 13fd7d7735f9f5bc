package org.collektive.generator

import java.io.File
import java.io.IOException
import java.io.PrintStream
import java.lang.reflect.InvocationTargetException
import java.nio.file.FileVisitOption
import java.nio.file.Files
import java.nio.file.Path
import java.nio.file.StandardCopyOption
import java.nio.file.attribute.FileTime
import java.time.Instant
import java.util.jar.Attributes
import java.util.jar.JarOutputStream
import java.util.jar.Manifest
import java.util.zip.ZipEntry
import javax.tools.ToolProvider
import kotlin.io.path.ExperimentalPathApi
import kotlin.io.path.deleteRecursively
import kotlin.io.path.isDirectory
import kotlin.io.path.isRegularFile

/**
 * Compiles a schema and its programs into a jar. It generates Java and Kotlin code, and runs the JDK's Java compiler and then the Kotlin
 * compiler, whose jars are on the class path. The compilers stay loaded, so later jars take a fraction of the time of the first jar.
 * Confined to one thread.
 */
internal object ProgramCompiler {
    const val USAGE: String =
        "usage: java -cp JARS_OF_KOTLIN:collektive-generator.jar org.collektive.generator.CompileCommand --flatc FILE --schema FILE.fbs " +
            "--include FOLDER [--csharp FOLDER] --jar FILE --work FOLDER [--source FILE_OR_FOLDER]... [--library JAR]... [--kotlin OPTION]... [--mark NAME:VALUE]..."

    private val options = setOf("--jar", "--work", "--source", "--library", "--kotlin", "--mark")

    /** The modification time of all entries. It is fixed, so that the same sources give the same jar. */
    private val TIME = FileTime.from(Instant.parse("2026-01-01T00:00:00Z"))

    init {
        // The compiler otherwise drops its view of the JDK and the libraries after each compilation.
        System.setProperty("kotlin.environment.keepalive", "true")
        System.setProperty("java.awt.headless", "true")
    }

    /**
     * Compiles programs as [USAGE] describes, prints messages to [log], and replaces the jar atomically. Overwrites the folders `generated` and `classes`
     * of the work folder.
     *
     * @return 0; 1 after an error; 2 after an exception in the Kotlin compiler or its plugin. After errors the jar is unchanged.
     */
    fun compile(words: List<String>, log: PrintStream): Int = try {
        val (own, others) = words.chunked(2).partition { it[0] in options }
        val values = own.groupBy({ it[0] }, { it.getOrNull(1) ?: throw GeneratorException("${it[0]} needs a value\n$USAGE") })
        compile(values.withDefault { emptyList() }, others.flatten(), log)
    } catch (e: GeneratorException) {
        log.println("generate: ${e.message}")
        1
    } catch (e: IOException) {
        log.println("generate: $e")
        1
    }

    @OptIn(ExperimentalPathApi::class)
    private fun compile(values: Map<String, List<String>>, generatorOptions: List<String>, log: PrintStream): Int {
        fun path(option: String) = Path.of(
            values.getValue(option).singleOrNull() ?: throw GeneratorException("exactly one $option is required\n$USAGE"),
        ).toAbsolutePath()
        val jar = path("--jar")
        val generated = path("--work").resolve("generated")
        val classes = path("--work").resolve("classes")
        val sources = values.getValue("--source")
        fun sourceFiles(extension: String) = sources.flatMap { files(Path.of(it), "").values }.filter { "$it".endsWith(extension) }
        // The Kotlin compiler reads Java files but does not compile them.
        sourceFiles(".java").firstOrNull()?.let {
            throw GeneratorException("$it: only Kotlin is compiled: convert this Java file to Kotlin, or move it to another folder")
        }
        val library = values.getValue("--library").joinToString(File.pathSeparator)
        generated.deleteRecursively()
        classes.deleteRecursively()
        Files.createDirectories(classes)
        val arguments = Arguments.parse((generatorOptions + listOf("--jvm", "$generated")).toTypedArray())
        // The hash is computed before the sources are read, so that changes during the compilation make the jar outdated.
        val hash = SourceHash.of(arguments.schemas.single(), sources.map(Path::of))
        generate(arguments)
        if (!compileJava(generated, classes, library, log)) return 1
        val code =
            compileKotlin("$library${File.pathSeparator}$classes", classes, sources + "$generated" + values.getValue("--kotlin"), log)
        if (code != 0) return code
        // A jar must not lose its programs if their files were deleted during the compilation.
        if (sources.any { Path.of(it).isDirectory() } && sourceFiles(".kt").isEmpty()) {
            throw GeneratorException("no Kotlin file (.kt) is in ${sources.joinToString()}, so ${jar.fileName} is not written")
        }
        val marks = values.getValue("--mark") + listOf("Collektive-Version:$VERSION", "Collektive-Sources:$hash")
        pack(jar, marks, files(generated.resolve("META-INF"), "META-INF/") + files(classes, ""))
        return 0
    }

    private fun compileJava(generated: Path, classes: Path, library: String, log: PrintStream): Boolean {
        val compiler = ToolProvider.getSystemJavaCompiler()
            ?: throw GeneratorException("${System.getProperty("java.home")} has no Java compiler: use a JDK")
        val arguments = listOf("--release", "17", "-nowarn", "-proc:none", "-cp", library, "-d", "$classes")
        val java = files(generated, "").values.filter { "$it".endsWith(".java") }.map(Path::toString)
        return compiler.run(null, log, log, *(arguments + java).toTypedArray()) == 0
    }

    private fun compileKotlin(library: String, classes: Path, others: List<String>, log: PrintStream): Int {
        val arguments = listOf("-no-stdlib", "-no-reflect", "-jvm-target", "17", "-cp", library, "-d", "$classes") + others
        val compiler = Class.forName("org.jetbrains.kotlin.cli.jvm.K2JVMCompiler")
        val exec = compiler.getMethod("exec", PrintStream::class.java, Array<String>::class.java)
        try {
            val code = exec.invoke(compiler.getConstructor().newInstance(), log, arguments.toTypedArray())
            return code.javaClass.getMethod("getCode").invoke(code) as Int
        } catch (e: InvocationTargetException) {
            throw e.targetException
        }
    }

    private fun pack(jar: Path, marks: List<String>, files: Map<String, Path>) {
        // Unity ignores names with a leading dot.
        val part = jar.resolveSibling(".${jar.fileName}.part")
        try {
            val manifest = Manifest()
            manifest.mainAttributes[Attributes.Name.MANIFEST_VERSION] = "1.0"
            for (mark in marks) manifest.mainAttributes.putValue(mark.substringBefore(':'), mark.substringAfter(':').trim())
            JarOutputStream(Files.newOutputStream(part)).use { output ->
                output.putNextEntry(ZipEntry("META-INF/MANIFEST.MF").setLastModifiedTime(TIME))
                manifest.write(output)
                for ((name, file) in files) {
                    output.putNextEntry(ZipEntry(name).setLastModifiedTime(TIME))
                    Files.copy(file, output)
                }
            }
            Files.move(part, jar, StandardCopyOption.ATOMIC_MOVE, StandardCopyOption.REPLACE_EXISTING)
        } finally {
            Files.deleteIfExists(part)
        }
    }

    /** Returns the files below [folder], sorted by their paths relative to [folder]. The keys are these paths after [prefix]. */
    private fun files(folder: Path, prefix: String): Map<String, Path> = Files.walk(folder, FileVisitOption.FOLLOW_LINKS).use { paths ->
        paths.filter { it.isRegularFile() }.toList().associateBy { prefix + folder.relativize(it).joinToString("/") }.toSortedMap()
    }
}
