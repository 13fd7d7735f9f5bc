package org.collektive.gradle

import org.apache.maven.model.Dependency
import org.apache.maven.model.Model
import org.codehaus.plexus.util.xml.Xpp3Dom
import org.gradle.api.GradleException
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
        configureKotlin()
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
        val settings = pom.plugin("maven-compiler-plugin").settings
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
        val executions = pom.plugin("kotlin-maven-plugin").executions.associate { it.id to it.settings }
        configureKotlin(executions.getValue("default-compile"), "compileKotlin", "main", "kotlinCompilerPluginClasspathMain")
        configureKotlin(executions.getValue("default-test-compile"), "compileTestKotlin", "test", "kotlinCompilerPluginClasspathTest")
    }

    private fun configureKotlin(settings: Xpp3Dom, task: String, sourceSet: String, pluginClasspath: String) {
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
        val plugin = pom.plugin("exec-maven-plugin")
        if (plugin.executions.isEmpty()) return
        val generated = project.file(pom.properties.getProperty("generated"))
        val commands = plugin.executions.map { command(it.settings) }
        val generators = project.configurations.create("generators") { it.isCanBeConsumed = false }
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

    /** Returns the command of an execution: the goal `exec` names an executable, the goal `java` a class. */
    private fun command(settings: Xpp3Dom): List<String> {
        val java = "${System.getProperty("java.home")}/bin/java"
        val start = settings.text("executable")?.let(::listOf) ?: listOf(java, checkNotNull(settings.text("mainClass")))
        return start + settings.texts("arguments")
    }

    /** Fails the build as `maven-enforcer-plugin` does when `./collektive setup` has not run. */
    private fun requireFiles() {
        for (rule in pom.plugin("maven-enforcer-plugin").executions.flatMap { it.settings.children("rules") }) {
            val files = rule.texts("files").map(::File)
            val message = checkNotNull(rule.text("message"))
            val task = tasks.register("requireFiles") {
                it.inputs.files(files)
                // It has no outputs.
                it.outputs.upToDateWhen { true }
                it.doLast { if (!files.all(File::exists)) throw GradleException(message) }
            }
            tasks.named("compileJava") { it.dependsOn(task) }
        }
    }

    private fun configureTests() {
        val settings = pom.plugin("maven-surefire-plugin").settings
        tasks.named("test", Test::class.java) { test ->
            test.dependsOn(packagedModules)
            test.useJUnitPlatform()
            test.jvmArgs(settings.text("argLine").orEmpty().split(' ').filter { it.isNotEmpty() })
            test.systemProperties(settings.children("systemPropertyVariables").associate { it.name to it.value })
            val repository = project.fileTree(project.rootDir) { it.include(REPOSITORY) }
            // A build creates folders without such files.
            test.inputs.files(repository).withPropertyName("repository").withPathSensitivity(PathSensitivity.RELATIVE).ignoreEmptyDirectories()
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
        val REPOSITORY = listOf("docs/architecture.md", "schema/**") +
            listOf("pom.xml", "*/pom.xml", "*/api/**", "*/src/test/**").map { "jvm-host/$it" }
    }
}
