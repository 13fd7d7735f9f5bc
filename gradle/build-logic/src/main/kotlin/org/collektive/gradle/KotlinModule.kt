package org.collektive.gradle

import org.gradle.api.Plugin
import org.gradle.api.Project
import org.gradle.api.tasks.testing.Test
import org.jetbrains.kotlin.gradle.dsl.JvmTarget
import org.jetbrains.kotlin.gradle.dsl.KotlinJvmProjectExtension
import org.jetbrains.kotlin.gradle.tasks.KotlinJvmCompile

/** A [JavaModule] in Kotlin, with an explicit API and without warnings, tested by JUnit. */
public class KotlinModule : Plugin<Project> {
    override fun apply(project: Project) {
        project.pluginManager.apply(JavaModule::class.java)
        project.pluginManager.apply("org.jetbrains.kotlin.jvm")
        compile(project)
        test(project)
    }

    private fun compile(project: Project) {
        val release = project.javaRelease
        project.extensions.configure(KotlinJvmProjectExtension::class.java) { kotlin ->
            kotlin.explicitApi()
            kotlin.compilerOptions.jvmTarget.set(JvmTarget.fromTarget("$release"))
            kotlin.compilerOptions.allWarningsAsErrors.set(true)
            kotlin.compilerOptions.freeCompilerArgs.add("-Xjdk-release=$release")
        }
        // The name stands in the classes; Maven takes this one.
        val module = project.name
        project.tasks.named("compileKotlin", KotlinJvmCompile::class.java) { it.compilerOptions.moduleName.set(module) }
    }

    private fun test(project: Project) {
        val libs = project.libs
        with(project.dependencies) {
            add("testImplementation", platform(libs.findLibrary("junit-bom").get()))
            add("testImplementation", libs.findLibrary("junit-jupiter").get())
            add("testImplementation", libs.findLibrary("kotlin-test").get())
            add("testRuntimeOnly", libs.findLibrary("junit-launcher").get())
        }
        project.tasks.withType(Test::class.java).configureEach {
            it.useJUnitPlatform()
            it.maxHeapSize = "384m"
        }
    }
}
