package org.collektive.gradle

import org.gradle.api.DefaultTask
import org.gradle.api.GradleException
import org.gradle.api.file.ConfigurableFileCollection
import org.gradle.api.provider.Property
import org.gradle.api.tasks.Input
import org.gradle.api.tasks.InputFiles
import org.gradle.api.tasks.TaskAction
import org.gradle.work.DisableCachingByDefault

/** Fails with [message] when one of [files] is missing. */
@DisableCachingByDefault(because = "it only checks whether files exist")
internal abstract class RequireFiles : DefaultTask() {
    @get:InputFiles
    abstract val files: ConfigurableFileCollection

    @get:Input
    abstract val message: Property<String>

    init {
        // It writes nothing: its inputs decide.
        outputs.upToDateWhen { true }
    }

    @TaskAction
    fun run() {
        if (files.any { !it.exists() }) throw GradleException(message.get())
    }
}
