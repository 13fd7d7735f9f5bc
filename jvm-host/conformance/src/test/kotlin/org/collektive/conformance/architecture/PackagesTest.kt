package org.collektive.conformance.architecture

import com.tngtech.archunit.core.domain.JavaClasses
import com.tngtech.archunit.core.importer.ClassFileImporter
import com.tngtech.archunit.core.importer.ImportOption
import com.tngtech.archunit.lang.syntax.ArchRuleDefinition.noClasses
import com.tngtech.archunit.library.dependencies.SlicesRuleDefinition.slices
import kotlin.test.Test
import kotlin.test.assertTrue

/** Tests dependency rules that the compiler cannot check, because the classes are in one module or on the class path anyway. */
class PackagesTest {
    @Test
    fun `all modules are on the class path`() {
        val names = "alignment api compiler engine frames generator host links mailbox runtime spi testing tools".split(' ')
        for (name in names) {
            assertTrue(classes.any { it.packageName.startsWith("org.collektive.$name") }, name)
        }
    }

    @Test
    fun `no two packages depend on each other`() = slices().matching("org.collektive.(**)").should().beFreeOfCycles().check(classes)

    @Test
    fun `the engine and runtimes do not use FlatBuffers`() = noClasses()
        .that().resideInAnyPackage(
            "org.collektive.spi..",
            "org.collektive.engine..",
            "org.collektive.runtime..",
            "org.collektive.api..",
            "it.unibo..",
        )
        .should().dependOnClassesThat().resideInAPackage("com.google.flatbuffers..").check(classes)

    @Test
    fun `the DSL and its library do not use the API for program authors, except for the links`() = noClasses()
        .that().resideInAnyPackage("it.unibo.collektive.(aggregate|networking|path|state|stdlib)..", "org.collektive.alignment..")
        .should().dependOnClassesThat().resideInAnyPackage("org.collektive.api..", "org.collektive.spi..", "org.collektive.links..")
        .check(classes)

    @Test
    fun `runtimes use nothing of the API for program authors beside the DSL`() = noClasses()
        .that().resideInAnyPackage("org.collektive.runtime..", "org.collektive.mailbox..", "org.collektive.spi..")
        .should().dependOnClassesThat().resideInAPackage("org.collektive.api..").check(classes)

    @Test
    fun `only frames and generated code write FlatBuffers`() = noClasses()
        .that().resideInAnyPackage("org.collektive.host..", "org.collektive.tools..")
        .should().dependOnClassesThat().haveFullyQualifiedName("com.google.flatbuffers.FlatBufferBuilder").check(classes)

    @Test
    fun `the host and its dependencies use neither the DSL nor a runtime`() = noClasses()
        .that().resideInAnyPackage(
            "org.collektive.host..",
            "org.collektive.frames..",
            "org.collektive.engine..",
            "org.collektive.spi..",
            "org.collektive.api..",
        )
        .should().dependOnClassesThat().resideInAnyPackage(
            "it.unibo..",
            "org.collektive.alignment..",
            "org.collektive.runtime..",
            "org.collektive.mailbox..",
        ).check(classes)

    private companion object {
        val classes: JavaClasses = ClassFileImporter().withImportOption(
            ImportOption.DoNotIncludeTests(),
        ).importPackages("org.collektive", "it.unibo")
    }
}
