package org.collektive.host.session

import org.collektive.frame.OpenRequest
import org.collektive.frames.session.types
import org.collektive.host.library.AggregateLibrary
import org.collektive.host.library.RuntimeCompatibility
import org.collektive.host.programs.JarBytes
import org.collektive.host.programs.ProgramFinder
import org.collektive.host.programs.ProgramJar
import org.collektive.host.programs.ProgramLoader
import org.collektive.host.programs.Programs
import org.collektive.host.programs.SchemaFinder
import org.collektive.host.shim.HostException

/** Loads the programs of the session that [request] opens, on the runtime of [library]. */
internal class ProgramSource(private val library: AggregateLibrary, request: OpenRequest) {
    private val schemaName = request.schema()
    private val types = request.types
    private val default = request.program().orEmpty()
    private val measured = List(request.metricsLength(), request::metrics)

    /**
     * Loads the programs in [jars] with a new class loader.
     *
     * @throws HostException when they cannot be loaded, or their schema is not the session's.
     */
    fun load(jars: List<JarBytes>): Programs {
        val programJars = jars.map(ProgramJar::open)
        RuntimeCompatibility(library).check(programJars)
        val loader = ProgramLoader(programJars, library.loader)
        val schemas = SchemaFinder.all(loader, programJars)
        val schema = SchemaFinder.find(schemaName, types, schemas, programJars)
        return Programs(ProgramFinder(programJars, loader, schema, schemas).find(), schema, loader, default, measured)
    }
}
