package org.collektive.host.programs

import org.collektive.frames.data.DataSchema
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import java.util.ServiceConfigurationError
import java.util.ServiceLoader

/** Finds the generated code of the schema that the C# side uses. */
public object SchemaFinder {
    /**
     * Returns all schemas in [jars], loaded by [loader].
     *
     * @throws HostException when their generated code cannot be loaded.
     */
    public fun all(loader: ClassLoader, jars: List<ProgramJar>): List<DataSchema> = try {
        ServiceLoader.load(DataSchema::class.java, loader).toList()
    } catch (e: LinkageError) {
        throw cannotLoad(jars, e)
    } catch (e: ServiceConfigurationError) {
        throw cannotLoad(jars, e)
    }

    /**
     * Returns the schema [name] of [all], whose types must have the fingerprints [types].
     *
     * @throws HostException when the schema is missing or a fingerprint differs; the message names the type.
     */
    public fun find(name: String, types: Map<String, Long>, all: List<DataSchema>, jars: List<ProgramJar>): DataSchema {
        val schema = all.find { it.name == name } ?: throw HostException(
            HostError.SCHEMA,
            "schema $name is missing in ${paths(jars)}, which contain ${all.map(DataSchema::name)}; $HINT",
        )
        for (type in (types.keys + schema.types.keys).sorted()) {
            if (types[type] == schema.types[type]) continue
            val how = when (type) {
                !in types -> "it is missing in C#"
                !in schema.types -> "it is missing in the programs' jar"
                else -> "its fields differ"
            }
            throw HostException(HostError.SCHEMA, "type $type of schema $name differs between C# and the programs' jar ($how); $HINT")
        }
        return schema
    }

    private fun cannotLoad(jars: List<ProgramJar>, e: Throwable) =
        HostException(HostError.SCHEMA, "the generated code in ${paths(jars)} cannot be loaded: $e; $HINT", e)

    private fun paths(jars: List<ProgramJar>) = jars.joinToString { it.path }

    private const val HINT = "run ./collektive generate for the schema, then rebuild the programs and the C# code"
}
