package org.collektive.gradle

import org.gradle.api.provider.Property
import org.gradle.api.tasks.Input
import org.gradle.work.DisableCachingByDefault

/** flatc's own Java: readers, and with [objects] classes of the object API. */
@DisableCachingByDefault(because = "flatc is a program of this machine")
public abstract class FlatcJava : SchemaTask() {
    /** Whether it makes the object API too. */
    @get:Input
    public abstract val objects: Property<Boolean>

    override fun generate() {
        processes.exec {
            it.executable(flatc.get().asFile)
            it.args("--java", "-o", output.get().asFile)
            if (objects.get()) it.args("--gen-object-api")
            it.args(schemas.files)
        }
    }
}
