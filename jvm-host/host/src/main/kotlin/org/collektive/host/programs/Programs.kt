package org.collektive.host.programs

import org.collektive.api.Program
import org.collektive.engine.NewNode
import org.collektive.frames.tick.NewNodes
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException

/** The programs of a session by name. Nodes without a program name run [default]. */
internal class Programs(private val byName: Map<String, LoadedProgram>, default: String) : NewNodes {
    /** The annotations of all programs, sorted by name. */
    val infos: List<Program> = byName.values.map(LoadedProgram::info)

    private val default = if (default.isEmpty()) null else find(default) { "the session" }

    override fun node(id: Int, program: String, parameters: Map<String, String>): NewNode {
        val wanted = if (program.isNotEmpty()) {
            find(program) { "node $id" }
        } else {
            default ?: throw HostException(HostError.PROGRAM, "node $id names no program, and the session has none either")
        }
        return NewNode(id, wanted, wanted.parameters(id, parameters))
    }

    private inline fun find(name: String, who: () -> String) = byName[name] ?: throw HostException(
        HostError.PROGRAM,
        "${who()} wants the program '$name', which is in none of the jars; " + if (byName.isEmpty()) {
            "they have no program at all: mark its function with @Program(\"$name\")"
        } else {
            "there are ${byName.keys}. Correct the name, or build the jar that has it"
        },
    )
}
