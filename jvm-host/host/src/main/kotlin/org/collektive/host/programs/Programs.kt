package org.collektive.host.programs

import org.collektive.api.Program
import org.collektive.engine.NewNode
import org.collektive.frames.data.DataSchema
import org.collektive.frames.tick.NewNodes
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException

/**
 * The programs and metrics of a session. Nodes that do not name a program run [default].
 *
 * @param measured names of the metrics that the session measures.
 * @property schema the schema of the user data.
 */
internal class Programs(
    functions: UserFunctions,
    val schema: DataSchema,
    val loader: JarLoader,
    private val default: String,
    measured: List<String>,
) : NewNodes {
    private val byName = functions.programs

    /** The measured metrics, in the session's order. */
    val metrics: List<LoadedMetric> = measured.map { name ->
        functions.metrics[name] ?: throw HostException(
            HostError.PROGRAM,
            "unknown metric '$name'; " + if (functions.metrics.isEmpty()) {
                "the jars contain no metrics: annotate the function with @Metric(\"$name\")"
            } else {
                "the jars contain ${functions.metrics.keys}. Correct the name, or rebuild the jars"
            },
        )
    }

    /** The annotations of all programs, sorted by name. */
    val infos: List<Program> = byName.values.map(LoadedProgram::info)

    private val defaultProgram = if (default.isEmpty()) null else find(default) { "the session" }

    override fun node(id: Int, program: String, parameters: Map<String, String>): NewNode {
        val selected = if (program.isNotEmpty()) {
            find(program) { "node $id" }
        } else {
            defaultProgram
                ?: throw HostException(
                    HostError.PROGRAM,
                    "node $id has no program, and the session has no default program; set one of them",
                )
        }
        val source = if (program.isEmpty() && parameters.isEmpty()) DEFAULT else Source(program, parameters)
        return NewNode(id, selected, selected.parameters(id, parameters), source)
    }

    /** Creates the node [id] again, with its program in this set; [source] is its [NewNode.source]. */
    fun node(id: Int, source: Any?): NewNode {
        val (program, parameters) = source as Source
        return node(id, program, parameters)
    }

    private data class Source(val program: String, val parameters: Map<String, String>)

    private inline fun find(name: String, owner: () -> String) = byName[name] ?: throw HostException(
        HostError.PROGRAM,
        "${owner()}: unknown program '$name'; " + if (byName.isEmpty()) {
            "the jars contain no programs: annotate the function with @Program(\"$name\")"
        } else {
            "the jars contain ${byName.keys}. Correct the name, or rebuild the jars"
        },
    )

    private companion object {
        /** The source of nodes that run the default program with its default parameters. */
        val DEFAULT = Source("", emptyMap())
    }
}
