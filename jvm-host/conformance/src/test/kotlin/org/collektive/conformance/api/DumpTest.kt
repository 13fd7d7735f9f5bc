package org.collektive.conformance.api

import it.unibo.collektive.Collektive
import org.collektive.api.Program
import org.collektive.schema.Vector3
import org.collektive.testing.TestNetwork
import org.jetbrains.kotlin.abi.tools.AbiFilters
import org.jetbrains.kotlin.abi.tools.AbiToolsFactory
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.TestFactory
import org.junit.jupiter.api.io.TempDir
import java.io.File
import java.nio.file.Path
import java.util.ServiceLoader
import kotlin.io.path.Path
import kotlin.io.path.copyTo
import kotlin.io.path.createParentDirectories
import kotlin.io.path.writeText
import kotlin.metadata.Visibility
import kotlin.metadata.isReified
import kotlin.metadata.jvm.KotlinClassMetadata
import kotlin.metadata.jvm.signature
import kotlin.metadata.visibility
import kotlin.reflect.KClass
import kotlin.test.fail

/** Compares the API of modules that programs use with `jvm-host/MODULE/api/MODULE.api`. [PublicApiTest] compares `dsl` and `stdlib`. */
internal class DumpTest {
    @TempDir
    lateinit var folder: Path

    private val tools = ServiceLoader.load(AbiToolsFactory::class.java).single().get()

    @TestFactory
    fun `the public API matches the checked-in list`() = MODULES.map { (name, sample) -> dynamicTest(name) { check(name, sample) } }

    private fun check(module: String, sample: KClass<*>) {
        val known = Path(System.getProperty("collektive.root"), "jvm-host", module, "api", "$module.api")
        val dump = folder.resolve("$module.api")
        dump.writeText(dump(File(sample.java.protectionDomain.codeSource.location.toURI())))
        if (System.getProperty("api.update").toBoolean()) dump.copyTo(known.createParentDirectories(), overwrite = true)
        tools.filesDiff(known.toFile(), dump.toFile())?.let {
            fail("the public API of module $module changed; if the change is intended, run: $UPDATE\n$it")
        }
    }

    private fun dump(place: File): String {
        val classes = place.walk().filter { it.isFile && it.extension in setOf("class", "jar") }.sorted().toList()
        return StringBuilder().also { tools.printJvmDump(it, classes, NAMES) }.toString() + reified(place)
    }

    /** Returns inline functions with reified types, which the dump omits because they are not part of the JVM API. */
    private fun reified(place: File): String = compiledKotlin(place).joinToString("") { (type, metadata) ->
        (metadata as? KotlinClassMetadata.FileFacade)?.kmPackage?.functions.orEmpty()
            .filter { it.visibility == Visibility.PUBLIC && it.typeParameters.any { parameter -> parameter.isReified } }
            .map { "inline fun ${type.packageName.replace('.', '/')}/${it.signature}\n" }.sorted().joinToString("")
    }

    private companion object {
        /** The modules that programs use, each with one of its classes. */
        val MODULES = mapOf(
            "runtime" to Collektive::class,
            "api" to Program::class,
            "frames" to Vector3::class,
            "testing" to TestNetwork::class,
        )

        /** The packages that programs use, and the packages of the functions that the compiler plugin calls. */
        val NAMES = AbiFilters(
            setOf(
                "it.unibo.**",
                "org.collektive.alignment.**",
                "org.collektive.api.**",
                "org.collektive.schema.**",
                "org.collektive.testing.**",
            ),
            emptySet(),
            emptySet(),
            emptySet(),
        )

        const val UPDATE =
            "mvn -f jvm-host/pom.xml -pl conformance -am package -Dtest=DumpTest -Dsurefire.failIfNoSpecifiedTests=false -Dapi.update=true"
    }
}
