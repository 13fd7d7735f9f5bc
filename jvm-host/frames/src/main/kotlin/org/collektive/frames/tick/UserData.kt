package org.collektive.frames.tick

import org.collektive.engine.RoundData
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.data.DataSchema
import org.collektive.frames.data.GlobalData
import java.nio.ByteBuffer

/** The user's data of each tick: sensors and global data for the rounds, and their answers. Each thread has its own view. */
public class UserData(private val schema: DataSchema, threads: Int) : RoundData {
    private val reader = schema.sensorReader()
    private val views = Array(threads) { schema.sensorView() }
    private val globals = schema.globalReader()?.let { GlobalData { checkNotNull(schema.globalReader()) } }
    internal val answers = Answers.of(schema)

    /**
     * Verifies the user's data of [request], read from [frame], once for all threads. Sets the global data of its tick.
     *
     * @throws MalformedFrameException when the data is malformed, or does not match the due nodes.
     */
    public fun read(frame: ByteBuffer, request: StepRequestReader) {
        val due = request.tick.due
        answers.begin(due)
        readSensors(frame, request.sensors, due.size)
        if (request.globals == 0) return
        val holder = globals ?: throw MalformedFrameException("it has global data, but schema ${schema.name} defines none")
        request.tick.globals = holder.read(frame, request.globals)
    }

    /** Puts the global data of [request] in use, if it has any. Call it once the tick is accepted. */
    public fun accept(request: StepRequestReader) {
        if (request.globals != 0) globals?.accept()
    }

    private fun readSensors(frame: ByteBuffer, position: Int, due: Int) {
        if (position == 0) {
            if (due == 0) return
            throw MalformedFrameException("it has no sensor data, but $due nodes are due")
        }
        reader.attach(frame, position)
        reader.check()
        if (reader.size != due) throw MalformedFrameException("it has sensor data of ${reader.size} nodes, but $due are due")
    }

    override fun sensors(worker: Int, index: Int): Any = views[worker].at(reader.place(index), reader.frame)

    override fun pack(worker: Int, index: Int, answer: Any): String? = answers.pack(worker, index, answer)
}
