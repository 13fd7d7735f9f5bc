package org.collektive.frames.tick

import org.collektive.engine.IntList
import org.collektive.engine.Links
import org.collektive.engine.NewNode
import org.collektive.engine.Tick
import org.collektive.frame.FrameLayouts
import org.collektive.frame.NodeAdded
import org.collektive.frame.Parameter
import org.collektive.frame.StepRequest
import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.OFFSET_BYTES
import org.collektive.frames.target
import java.nio.ByteBuffer

/** Creates the nodes that a frame adds or changes. */
public fun interface NewNodes {
    /** Creates the node [id]. An empty [program] selects the session's default; [parameters] contains only overridden values. */
    public fun node(id: Int, program: String, parameters: Map<String, String>): NewNode
}

/** Reads `StepRequest` frames in place, and attaches [data] to their user data. Allocates only for new nodes. Not thread-safe. */
public class StepRequestReader(private val newNodes: NewNodes, private val data: UserData) {
    private val checker = FrameChecker(FramePolicy.FRAME)
    private val request = StepRequest()
    private val node = NodeAdded()
    private val parameter = Parameter()
    private val links = FrameLinks()
    private var frame = ByteBuffer.allocate(0)
    private var root = 0
    private val tick = Tick()

    /**
     * Verifies [frame], which the next [read] reads.
     *
     * @throws MalformedFrameException when the frame is malformed.
     */
    public fun check(frame: ByteBuffer) {
        root = checker.checkRoot(frame, FrameLayouts.STEP_REQUEST)
        this.frame = frame
        request.__assign(root, frame)
    }

    /** The jars with which the checked frame replaces all programs, or `null`. Allocates. */
    public val reloadedJars: List<String>?
        get() {
            if (target(frame, root, FrameLayouts.STEP_REQUEST_RELOAD) == 0) return null
            return request.reload().let { List(it.jarsLength(), it::jars) }
        }

    /**
     * Reads the checked frame.
     *
     * @return the tick, valid until the next call and as long as the frame. [UserData.accept] makes its global data current.
     * @throws MalformedFrameException when a node sets a parameter twice, or the user's data does not match the due nodes.
     */
    public fun read(): Tick {
        tick.clear()
        tick.number = request.tick()
        tick.time = request.time()
        tick.deltaTime = request.deltaTime()
        tick.measuresMessages = request.measureMessages()
        tick.measures = request.measure()
        tick.inspected = request.inspected()
        tick.nodesRemoved.addVector(FrameLayouts.STEP_REQUEST_NODES_REMOVED, 1)
        for (index in 0 until request.nodesAddedLength()) tick.nodesAdded.add(newNode(request.nodesAdded(node, index)))
        for (index in 0 until request.nodesChangedLength()) tick.nodesChanged.add(newNode(request.nodesChanged(node, index)))
        tick.linksRemoved.addVector(FrameLayouts.STEP_REQUEST_LINKS_REMOVED, IDS_OF_A_LINK)
        links.attach(frame, target(frame, root, FrameLayouts.STEP_REQUEST_LINKS))
        tick.links = links
        tick.due.addVector(FrameLayouts.STEP_REQUEST_DUE, 1)
        try {
            data.readSensors(frame, target(frame, root, FrameLayouts.STEP_REQUEST_SENSORS), tick.due)
            tick.globals = data.readGlobals(frame, target(frame, root, FrameLayouts.STEP_REQUEST_GLOBALS))
        } catch (e: MalformedFrameException) {
            throw MalformedFrameException(e.message.orEmpty(), tick.number)
        }
        return tick
    }

    /** Appends the vector in the field at [entry], whose elements have [width] ids each. */
    private fun IntList.addVector(entry: Int, width: Int) {
        val vector = target(frame, root, entry)
        if (vector != 0) addAll(frame, vector + OFFSET_BYTES, width * frame.getInt(vector))
    }

    private fun newNode(added: NodeAdded): NewNode =
        newNodes.node(added.id(), added.program().orEmpty(), if (added.parametersLength() == 0) emptyMap() else parameters(added))

    private fun parameters(added: NodeAdded): Map<String, String> {
        val parameters = LinkedHashMap<String, String>()
        for (index in 0 until added.parametersLength()) {
            added.parameters(parameter, index)
            if (parameters.put(parameter.name(), parameter.value()) != null) {
                throw MalformedFrameException("node ${added.id()} sets the parameter '${parameter.name()}' twice")
            }
        }
        return parameters
    }

    /** The vector of `Link`s of a frame. */
    private class FrameLinks : Links {
        private var frame = ByteBuffer.allocate(0)
        private var first = 0
        override var size = 0
            private set

        fun attach(frame: ByteBuffer, vector: Int) {
            this.frame = frame
            size = if (vector == 0) 0 else frame.getInt(vector)
            first = vector + OFFSET_BYTES
        }

        override fun from(index: Int) = frame.getInt(first + index * BYTES)

        override fun to(index: Int) = frame.getInt(first + index * BYTES + TO)

        override fun length(index: Int) = frame.getFloat(first + index * BYTES + LENGTH)

        override fun attenuation(index: Int) = frame.getFloat(first + index * BYTES + ATTENUATION)

        /** Byte offsets in the struct `Link`, and its size. */
        private companion object {
            const val TO = 4
            const val LENGTH = 8
            const val ATTENUATION = 12
            const val BYTES = 16
        }
    }

    private companion object {
        const val IDS_OF_A_LINK = 2
    }
}
