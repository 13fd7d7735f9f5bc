package org.collektive.testing

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.api.Device
import java.io.File
import java.io.PrintStream
import java.lang.reflect.InvocationTargetException
import java.lang.reflect.Method
import java.lang.reflect.Modifier
import java.util.jar.JarFile

/**
 * Runs the functions of a jar on networks for `./collektive compare-runtimes`. The arguments are the jar, which is also on the class path,
 * and the name of the runtime.
 *
 * Prints the names of the functions, one per line, and an empty line. Then reads requests from standard input: `SEED LOSS FUNCTION`, one
 * line `NODES|LINKS|DUE` per tick such as `0 1 2|0-1 1-2|0 2`, and an empty line. For each request, prints one line `TICK NODE RESULT` per
 * round, and an empty line.
 */
internal fun main(arguments: Array<String>) {
    val output = PrintStream(System.out, false, Charsets.UTF_8)
    // Programs may write to standard output.
    System.setOut(System.err)
    val (jar, runtime) = arguments
    val functions = functions(File(jar)).groupBy { it.name }
    // The caller refuses names that are printed several times.
    functions.values.flatten().sortedBy { it.name }.forEach { output.println(it.name) }
    output.println()
    output.flush()
    while (true) {
        val (seed, loss, name) = (readlnOrNull() ?: return).split(' ', limit = 3)
        val function = functions.getValue(name).single()
        val ticks = generateSequence(::readlnOrNull).takeWhile { it.isNotEmpty() }.toList()
        TestNetwork(seed.toLong(), runtime = runtime, loss = loss.toDouble()).use { network ->
            ticks.forEachIndexed { index, tick ->
                for ((id, result) in network.run(tick, function)) output.println("${index + 1} $id ${text(result)}")
            }
        }
        output.println()
        output.flush()
    }
}

/** Returns the public top-level functions in [jar] whose parameters are the aggregate and, optionally, the device. */
private fun functions(jar: File): List<Method> {
    val names = JarFile(jar).use { file -> file.entries().toList().map { it.name } }
    return names.filter { it.endsWith(".class") && !it.startsWith("org/collektive/links/") }
        .map { Class.forName(it.removeSuffix(".class").replace('/', '.'), false, Device::class.java.classLoader) }
        .filter { it.getAnnotation(Metadata::class.java)?.kind in FACADES }
        .flatMap { it.declaredMethods.toList() }
        .filter { Modifier.isPublic(it.modifiers) && Modifier.isStatic(it.modifiers) && !it.isSynthetic }
        .filter { it.parameterTypes.sortedBy(Class<*>::getSimpleName) in SIGNATURES }
}

/** Kinds of Kotlin classes that contain top-level functions: those of one file, and of several files. */
private val FACADES = setOf(2, 4)

private val SIGNATURES = listOf(listOf(Aggregate::class.java), listOf(Aggregate::class.java, Device::class.java))

private fun TestNetwork.run(tick: String, function: Method): Map<Int, Result<Any?>> {
    val (nodeIds, linkEnds, dueIds) = tick.split('|').map { part -> part.split(' ').filter { it.isNotEmpty() } }
    val ids = nodeIds.mapTo(sortedSetOf(), String::toInt)
    (nodes - ids).forEach(::remove)
    (ids - nodes).forEach { add(it) }
    val links = linkEnds.mapTo(HashSet()) { link -> link.split('-').map(String::toInt).let { it[0] to it[1] } }
    for (a in nodes) for (b in nodes.filter { it > a }) if (a to b in links) link(a, b) else unlink(a, b)
    return outcomes(dueIds.mapTo(HashSet(), String::toInt)) { device ->
        val values = function.parameterTypes.map { if (it == Device::class.java) device else this }
        try {
            function.invoke(null, *values.toTypedArray())
        } catch (e: InvocationTargetException) {
            throw e.targetException
        }
    }
}

private fun text(result: Result<Any?>): String {
    // Quotes distinguish a text from other values, such as null, and from an error.
    val text = result.fold({ if (it is String) "\"$it\"" else "$it" }, { "fails (${(it.cause ?: it).javaClass.simpleName})" })
    return text.replace("\\", "\\\\").replace("\n", "\\n").replace("\r", "\\r")
}
