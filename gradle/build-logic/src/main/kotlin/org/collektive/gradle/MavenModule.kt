package org.collektive.gradle

import org.apache.maven.model.Dependency
import org.apache.maven.model.Model
import org.codehaus.plexus.util.xml.Xpp3Dom
import org.gradle.api.Project
import org.gradle.api.tasks.PathSensitivity
import org.gradle.api.tasks.SourceSet
import org.gradle.api.tasks.SourceSetContainer
import org.gradle.api.tasks.compile.JavaCompile
import org.gradle.api.tasks.testing.Test
import org.gradle.language.jvm.tasks.ProcessResources
import org.jetbrains.kotlin.gradle.dsl.JvmTarget
import org.jetbrains.kotlin.gradle.dsl.KotlinJvmProjectExtension
import org.jetbrains.kotlin.gradle.tasks.KotlinJvmCompile
import java.io.File

/** Configures [project] as [pom] describes it. */
internal class MavenModule(private val project: Project, private val pom: Model) {
    private val tasks = project.tasks
    private val release = pom.properties.getProperty("java.release")
    private val main by lazy { project.extensions.getByType(SourceSetContainer::class.java).getByName(SourceSet.MAIN_SOURCE_SET_NAME) }

    /** The tasks that package the modules on which this one depends, as Maven does first. */
    private val packagedModules = pom.dependencies.filter { it.groupId == pom.groupId }.map { ":${it.artifactId}:assemble" }

    fun configure() {
        project.group = pom.groupId
        project.version = pom.version
        project.pluginManager.apply("java-library")
        pom.dependencies.forEach(::addDependency)
        configureJava()
        if (pom.plugin("kotlin-maven-plugin") != null) configureKotlin()
        configureResources()
        generateSources()
        requireFiles()
        configureTests()
        configureJars(project, pom, main.output)
    }

    private fun addDependency(dependency: Dependency) = with(project.dependencies) {
        for (configuration in CONFIGURATIONS.getValue(dependency.scope)) add(configuration, notation(dependency))
        // Maven's test plugin adds the launcher itself.
        if (dependency.artifactId == "junit-jupiter") {
            add("testRuntimeOnly", platform("org.junit:junit-bom:${dependency.version}"))
            add("testRuntimeOnly", "org.junit.platform:junit-platform-launcher")
        }
    }

    private fun notation(dependency: Dependency): Any =
        with(dependency) { if (groupId == pom.groupId) module(artifactId) else "$groupId:$artifactId:$version" }

    private fun module(name: String) = project.dependencies.project(mapOf("path" to ":$name"))

    private fun configureJava() {
        main.java.setSrcDirs(listOf(pom.build.sourceDirectory))
        tasks.withType(JavaCompile::class.java).configureEach { it.options.release.set(release.toInt()) }
        val settings = pom.settings("maven-compiler-plugin")
        val processors = settings.texts("annotationProcessors")
        tasks.named("compileJava", JavaCompile::class.java) {
            it.options.compilerArgs.addAll(settings.texts("compilerArgs"))
            if (processors.isNotEmpty()) {
                it.options.annotationProcessorPath = main.compileClasspath
                it.options.compilerArgs.addAll(listOf("-processor", processors.joinToString(",")))
            }
        }
    }

    private fun configureKotlin() {
        project.pluginManager.apply("org.jetbrains.kotlin.jvm")
        // The name is part of the classes.
        tasks.named("compileKotlin", KotlinJvmCompile::class.java) { it.compilerOptions.moduleName.set(pom.artifactId) }
        configureKotlin("default-compile", "compileKotlin", "main", "kotlinCompilerPluginClasspathMain")
        configureKotlin("default-test-compile", "compileTestKotlin", "test", "kotlinCompilerPluginClasspathTest")
    }

    private fun configureKotlin(execution: String, task: String, sourceSet: String, pluginClasspath: String) {
        val settings = pom.executions("kotlin-maven-plugin").first { it.id == execution }.settings
        val kotlin = project.extensions.getByType(KotlinJvmProjectExtension::class.java)
        kotlin.sourceSets.getByName(sourceSet).kotlin.srcDirs(settings.texts("sourceDirs") - pom.properties["generated"])
        val (plugins, flags) = settings.texts("args").partition { it.startsWith("-Xplugin=") }
        tasks.named(task, KotlinJvmCompile::class.java) {
            it.compilerOptions.jvmTarget.set(JvmTarget.fromTarget(release))
            it.compilerOptions.freeCompilerArgs.addAll(flags)
        }
        for (plugin in plugins) project.dependencies.add(pluginClasspath, compilerPlugin(File(plugin).name))
    }

    /** Returns the dependency or the module whose jar has the name [jar]. */
    private fun compilerPlugin(jar: String): Any {
        val dependency = pom.dependencies.find { "${it.artifactId}-${it.version}.jar" == jar }
        return if (dependency != null) notation(dependency) else module(jar.removeSuffix("-${pom.version}.jar"))
    }

    private fun configureResources() {
        val inherited = project.file("src/main/resources")
        tasks.named("processResources", ProcessResources::class.java) { task ->
            for (resource in pom.build.resources.filter { File(it.directory) != inherited }) {
                task.from(resource.directory) {
                    it.into(resource.targetPath.orEmpty())
                    it.include(resource.includes)
                }
            }
        }
    }

    /** Runs the commands of `exec-maven-plugin`, which write to the directory in the property `generated`. */
    private fun generateSources() {
        val plugin = pom.plugin("exec-maven-plugin") ?: return
        val generated = project.file(pom.properties.getProperty("generated"))
        val commands = plugin.executions.map { command(it.settings) }
        val generators = project.configurations.create("generators") {
            it.isCanBeConsumed = false
            it.extendsFrom(project.configurations.getByName("compileOnly"))
        }
        for (dependency in plugin.dependencies) project.dependencies.add(generators.name, notation(dependency))
        val task = tasks.register("generateSources", GenerateSources::class.java) {
            it.dependsOn(packagedModules)
            it.commands.set(commands)
            it.sources.from(commands.flatten().map(::File).filter { argument -> argument.isAbsolute && argument != generated })
            it.classpath.from(generators)
            it.output.set(generated)
        }
        main.java.srcDir(task)
        tasks.named("processResources") { it.dependsOn(task) }
    }

    /** Returns the command of an execution: that of the goal `exec` names an executable, that of `java` a class. */
    private fun command(settings: Xpp3Dom): List<String> {
        val mainClass = settings.text("mainClass")
        val java = File(System.getProperty("java.home"), "bin/java").path
        val executable = settings.text("executable").orEmpty()
        val start = if (mainClass == null) listOf(executable) else listOf(java, "-classpath", GenerateSources.CLASSPATH, mainClass)
        return start + settings.texts("arguments")
    }

    /** Fails the build as `maven-enforcer-plugin` does when `./collektive setup` has not run. */
    private fun requireFiles() {
        for (rule in pom.executions("maven-enforcer-plugin").flatMap { it.settings.children("rules") }) {
            val task = tasks.register("requireFiles", RequireFiles::class.java) {
                it.files.from(rule.texts("files"))
                it.message.set(rule.text("message"))
            }
            tasks.named("compileJava") { it.dependsOn(task) }
        }
    }

    private fun configureTests() {
        val settings = pom.settings("maven-surefire-plugin")
        val properties = settings.children("systemPropertyVariables").associate { it.name to it.value }
        tasks.named("test", Test::class.java) { test ->
            test.dependsOn(packagedModules)
            test.useJUnitPlatform()
            test.jvmArgs(settings.text("argLine").orEmpty().split(' ').filter { it.isNotEmpty() })
            test.systemProperties(properties)
            if (project.rootDir.path in properties.values) {
                val repository = project.fileTree(project.rootDir) { it.include(REPOSITORY) }
                test.inputs.files(repository).withPropertyName("repository").withPathSensitivity(PathSensitivity.RELATIVE)
            }
        }
    }

    private companion object {
        val CONFIGURATIONS = mapOf(
            "compile" to listOf("api"),
            "provided" to listOf("compileOnly", "testImplementation"),
            "runtime" to listOf("runtimeOnly"),
            "test" to listOf("testImplementation"),
        )

        /** The files that tests find below the root of the repository. */
        val REPOSITORY = listOf(
            "docs/**",
            "schema/**",
            "unity/**/*.fbs",
            "unity/**/Generated/**",
            "jvm-host/pom.xml",
            "jvm-host/*/pom.xml",
            "jvm-host/*/api/**",
            "jvm-host/*/src/**",
        )
    }
}
