package org.collektive.host

import org.collektive.engine.NewNode
import org.collektive.engine.Tick
import org.collektive.frame.Link
import org.collektive.frame.LinkId
import org.collektive.frame.NodeAdded
import org.collektive.frame.Parameter
import org.collektive.frame.StepRequest
import java.nio.ByteBuffer

/** Reads `StepRequest`s; allocates only for nodes that come. */
internal class StepFrame(private val programs: Map<String, LoadedProgram>, private val defaultProgram: LoadedProgram?) {
    private val verifier = FrameVerifier()
    private val request = StepRequest()
    private val node = NodeAdded()
    private val parameter = Parameter()
    private val linkId = LinkId()
    private val link = Link()

    /** What the frame asks of the engine, without the user's data. */
    val tick = Tick()

    /** Position of the table `Sensors`, 0 when absent. */
    var sensors = 0
        private set

    /** Position of the table `GlobalData`, 0 when absent. */
    var globals = 0
        private set

    /** Checks [frame] and reads all of it but the user's data. */
    fun read(frame: ByteBuffer) {
        val root = verifier.verify(frame, FrameShapes.stepRequest)
        request.__assign(root, frame)
        sensors = verifier.target(root, FrameShapes.SENSORS)
        globals = verifier.target(root, FrameShapes.GLOBALS)
        tick.clear()
        tick.number = request.tick()
        tick.time = request.time()
        tick.deltaTime = request.deltaTime()
        for (index in 0 until request.nodesRemovedLength()) tick.nodesRemoved.add(request.nodesRemoved(index))
        for (index in 0 until request.nodesAddedLength()) tick.nodesAdded.add(newNode(request.nodesAdded(node, index)))
        for (index in 0 until request.linksRemovedLength()) {
            request.linksRemoved(linkId, index)
            tick.linksRemoved.add(linkId.from())
            tick.linksRemoved.add(linkId.to())
        }
        for (index in 0 until request.linksLength()) {
            request.links(link, index)
            tick.links.add(link.from(), link.to(), link.length(), link.attenuation())
        }
        val due = verifier.target(root, FrameShapes.DUE)
        if (due != 0) tick.due.addAll(frame, due + Int.SIZE_BYTES, frame.getInt(due))
    }

    private fun newNode(added: NodeAdded): NewNode {
        val id = added.id()
        val name = added.program().orEmpty()
        val program = if (name.isEmpty()) {
            defaultProgram ?: throw HostException(HostError.PROGRAM, "node $id names no program, and the session has none either")
        } else {
            programs[name] ?: throw noSuchProgram("node $id", name, programs.keys)
        }
        val count = added.parametersLength()
        if (count == 0) return NewNode(id, program, program.parameters(id, emptyMap()))
        val values = HashMap<String, String>()
        for (index in 0 until count) {
            added.parameters(parameter, index)
            if (values.put(parameter.name(), parameter.value()) != null) {
                throw HostException(HostError.FRAME, "node $id sets the parameter '${parameter.name()}' twice")
            }
        }
        return NewNode(id, program, program.parameters(id, values))
    }

    companion object {
        fun noSuchProgram(who: String, name: String, known: Set<String>) = HostException(
            HostError.PROGRAM,
            "$who wants the program '$name', which is in none of the jars; there are $known. Correct the name, or build the jar that has it",
        )
    }
}
