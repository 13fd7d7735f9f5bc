package org.collektive.gradle

import org.gradle.api.DefaultTask
import org.gradle.api.file.ConfigurableFileCollection
import org.gradle.api.file.DirectoryProperty
import org.gradle.api.file.FileSystemOperations
import org.gradle.api.provider.ListProperty
import org.gradle.api.tasks.Classpath
import org.gradle.api.tasks.Input
import org.gradle.api.tasks.InputFiles
import org.gradle.api.tasks.OutputDirectory
import org.gradle.api.tasks.PathSensitive
import org.gradle.api.tasks.PathSensitivity
import org.gradle.api.tasks.TaskAction
import org.gradle.process.ExecOperations
import org.gradle.work.DisableCachingByDefault
import javax.inject.Inject

/** Runs [commands] in their order, after which [output] contains only the files that they generated. Java finds classes in [classpath]. */
@DisableCachingByDefault(because = "flatc is a program of this machine")
internal abstract class GenerateSources : DefaultTask() {
    @get:Input
    abstract val commands: ListProperty<List<String>>

    @get:InputFiles
    @get:PathSensitive(PathSensitivity.RELATIVE)
    abstract val sources: ConfigurableFileCollection

    @get:Classpath
    abstract val classpath: ConfigurableFileCollection

    @get:OutputDirectory
    abstract val output: DirectoryProperty

    @get:Inject
    protected abstract val files: FileSystemOperations

    @get:Inject
    protected abstract val processes: ExecOperations

    @TaskAction
    fun run() {
        files.delete { it.delete(output) }
        output.get().asFile.mkdirs()
        for (command in commands.get()) {
            processes.exec { it.commandLine(command).environment("CLASSPATH", classpath.asPath) }
        }
    }
}
