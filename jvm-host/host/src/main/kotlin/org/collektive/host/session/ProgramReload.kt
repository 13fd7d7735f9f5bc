package org.collektive.host.session

import org.collektive.engine.Engine
import org.collektive.engine.Reload
import org.collektive.frames.tick.StepRequestReader
import org.collektive.frames.tick.UserData
import org.collektive.host.programs.JarBytes
import org.collektive.host.programs.Programs
import org.collektive.host.programs.ReloadedValues
import org.collektive.host.shim.HostException

/** Programs of a session, with the reader and the data of their schema's classes. */
internal class LoadedPrograms(val programs: Programs, threads: Int) {
    val data = UserData(programs.schema, threads)
    val requests = StepRequestReader(programs, data)
}

/**
 * Loads new programs for the nodes of [engine].
 *
 * @property readJars reads jars from their paths; throws [HostException] when one cannot be read.
 */
internal class ProgramReload(
    private val source: ProgramSource,
    private val engine: Engine,
    private val threads: Int,
    val readJars: (List<String>) -> List<JarBytes>,
) {
    /** Loads the programs in [jars], to replace [old]. Changes nothing. */
    fun prepare(jars: List<JarBytes>, old: LoadedPrograms): PreparedReload = try {
        val programs = source.load(jars)
        val change = Reload(engine.replacements(programs::node), ReloadedValues(old.programs.loader, programs.loader))
        PreparedReload(LoadedPrograms(programs, threads), change, "")
    } catch (e: HostException) {
        PreparedReload(old, null, e.message.orEmpty())
    } catch (e: Throwable) {
        // A damaged jar can cause any exception.
        PreparedReload(old, null, "the classes in ${jars.joinToString { it.path }} cannot be loaded: $e; rebuild the programs")
    }
}

/** The programs of the next tick: [loaded] with the [change] to them, or the previous ones and the [error] of the reload. */
internal class PreparedReload(val loaded: LoadedPrograms, val change: Reload?, val error: String)
