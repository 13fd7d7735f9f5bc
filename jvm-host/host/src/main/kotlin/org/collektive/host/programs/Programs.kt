package org.collektive.host.programs

import org.collektive.api.Program
import org.collektive.engine.NewNode
import org.collektive.frames.tick.NewNodes
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException

/** The programs of a session by name. Nodes that do not name a program run [default]. */
internal class Programs(private val byName: Map<String, LoadedProgram>, default: String) : NewNodes {
    /** The annotations of all programs, sorted by name. */
    val infos: List<Program> = byName.values.map(LoadedProgram::info)

    private val default = if (default.isEmpty()) null else find(default) { "the session" }

    override fun node(id: Int, program: String, parameters: Map<String, String>): NewNode {
        val selected = if (program.isNotEmpty()) {
            find(program) { "node $id" }
        } else {
            default
                ?: throw HostException(
                    HostError.PROGRAM,
                    "node $id has no program, and the session has no default program; set one of them",
                )
        }
        return NewNode(id, selected, selected.parameters(id, parameters))
    }

    private inline fun find(name: String, owner: () -> String) = byName[name] ?: throw HostException(
        HostError.PROGRAM,
        "${owner()}: unknown program '$name'; " + if (byName.isEmpty()) {
            "the jars contain no programs: annotate the function with @Program(\"$name\")"
        } else {
            "the jars contain ${byName.keys}. Correct the name, or rebuild the jars"
        },
    )
}
