package org.collektive.generator

import java.nio.file.Path
import kotlin.system.exitProcess

/**
 * Compiles programs into a jar as [ProgramCompiler.USAGE] describes, and exits with the code of [ProgramCompiler.compile]. With
 * `--serve FOLDER PROCESS`, [serves][CompileServer] requests in a folder until another process ends.
 */
public object CompileCommand {
    /** See [CompileCommand]. */
    @JvmStatic
    public fun main(arguments: Array<String>) {
        if (arguments.firstOrNull() != "--serve") exitProcess(ProgramCompiler.compile(arguments.toList(), System.err))
        val client = ProcessHandle.of(arguments[2].toLong())
        // The process may have ended already.
        if (client.isEmpty) return
        client.get().onExit().thenRun { exitProcess(0) }
        CompileServer(Path.of(arguments[1])).run()
    }
}
