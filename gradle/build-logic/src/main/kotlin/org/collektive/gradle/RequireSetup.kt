package org.collektive.gradle

import org.gradle.api.DefaultTask
import org.gradle.api.GradleException
import org.gradle.api.file.ConfigurableFileCollection
import org.gradle.api.tasks.InputFiles
import org.gradle.api.tasks.TaskAction
import org.gradle.work.DisableCachingByDefault

/** Fails when `./collektive setup` has not made [files] yet. */
@DisableCachingByDefault(because = "it only looks whether files exist")
public abstract class RequireSetup : DefaultTask() {
    @get:InputFiles
    public abstract val files: ConfigurableFileCollection

    init {
        // It makes nothing: what it read last time decides.
        outputs.upToDateWhen { true }
    }

    @TaskAction
    public fun check() {
        val missing = files.firstOrNull { !it.exists() } ?: return
        throw GradleException("$missing is missing: run ./collektive setup")
    }
}
