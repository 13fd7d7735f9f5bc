package org.collektive.gradle

import org.gradle.work.DisableCachingByDefault

/** flatc's own Java: readers, and classes of the object API. */
@DisableCachingByDefault(because = "flatc is a program of this machine")
public abstract class FlatcJava : SchemaTask() {
    override fun generate() {
        processes.exec {
            it.executable(flatc.get().asFile)
            it.args("--java", "--gen-object-api", "-o", output.get().asFile)
            it.args(schemas.files)
        }
    }
}
