package org.collektive.gradle

import org.gradle.api.file.ConfigurableFileCollection
import org.gradle.api.file.RegularFileProperty
import org.gradle.api.provider.Property
import org.gradle.api.tasks.Classpath
import org.gradle.api.tasks.Input
import org.gradle.api.tasks.InputFile
import org.gradle.api.tasks.PathSensitive
import org.gradle.api.tasks.PathSensitivity
import org.gradle.work.DisableCachingByDefault

/** Java and Kotlin by our generator, which runs once for each schema. */
@DisableCachingByDefault(because = "flatc is a program of this machine")
public abstract class GeneratorJava : SchemaTask() {
    /** The module `generator` with what it needs. */
    @get:Classpath
    public abstract val generator: ConfigurableFileCollection

    /** `types.fbs`, which schemas may include. */
    @get:InputFile
    @get:PathSensitive(PathSensitivity.NONE)
    public abstract val coreTypes: RegularFileProperty

    /** What the generator makes, as its command line says it: `--jvm` or `--layouts`. */
    @get:Input
    public abstract val product: Property<String>

    override fun generate() {
        for (schema in schemas.files) {
            processes.javaexec {
                it.classpath(generator)
                it.mainClass.set("org.collektive.generator.MainKt")
                it.args("--flatc", flatc.get().asFile, "--include", coreTypes.get().asFile.parentFile)
                it.args("--schema", schema, product.get(), output.get().asFile)
            }
        }
    }
}
