package org.collektive.frames.tick

import org.collektive.engine.RoundData
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.data.DataSchema
import org.collektive.frames.data.GlobalData
import java.nio.ByteBuffer

/** The user's data of one tick after the other, on its way into the rounds and out of them. Each thread has a reader of its own. */
public class UserData(private val schema: DataSchema, threads: Int) : RoundData {
    private val readers = Array(threads) { schema.sensorReader() }
    private val globals = schema.globalReader()?.let { GlobalData { checkNotNull(schema.globalReader()) } }
    internal val answers = Answers.of(schema, threads)

    /**
     * Checks the data of [request], which was read from [frame], once for all threads, and gives its tick the global data.
     *
     * @throws MalformedFrameException when they cannot be read, or do not fit the due nodes.
     */
    public fun read(frame: ByteBuffer, request: StepRequestReader) {
        val due = request.tick.due
        answers.begin(due)
        readSensors(frame, request.sensors, due.size)
        if (request.globals == 0) return
        val holder = globals ?: throw MalformedFrameException("it has global data, but schema ${schema.name} defines none")
        request.tick.globals = holder.read(frame, request.globals)
    }

    /** The tick last read was accepted: its global data, if it had any, is in use from now on. */
    public fun accept(request: StepRequestReader) {
        if (request.globals != 0) globals?.accept()
    }

    private fun readSensors(frame: ByteBuffer, position: Int, due: Int) {
        if (position == 0) {
            if (due == 0) return
            throw MalformedFrameException("it has no sensor data, but $due nodes are due")
        }
        val checked = readers[0]
        checked.attach(frame, position)
        checked.check()
        if (checked.size != due) throw MalformedFrameException("it has sensor data of ${checked.size} nodes, but $due are due")
        for (worker in 1 until readers.size) readers[worker].follow(checked)
    }

    override fun sensors(worker: Int, index: Int): Any = readers[worker][index]

    override fun pack(worker: Int, index: Int, answer: Any): String? = answers.pack(worker, index, answer)
}
