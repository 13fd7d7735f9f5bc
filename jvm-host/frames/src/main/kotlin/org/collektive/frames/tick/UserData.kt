package org.collektive.frames.tick

import org.collektive.engine.IntList
import org.collektive.engine.RoundData
import org.collektive.engine.Tick
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.data.DataSchema
import org.collektive.frames.data.GlobalData
import java.nio.ByteBuffer

/** The user data of each tick: sensor and global data for the rounds, and their answers. Each thread has its own view. */
public class UserData(private val schema: DataSchema, threads: Int) : RoundData {
    private val reader = schema.sensorReader()
    private val views = Array(threads) { schema.sensorView() }
    private val globals = schema.globalReader()?.let { GlobalData { checkNotNull(schema.globalReader()) } }
    internal val answers = Answers.of(schema)

    /**
     * Verifies the sensor data of [due] in the table `Sensors` at [position] of [frame], once for all threads. A position of 0 means that it is absent.
     *
     * @throws MalformedFrameException when the data is malformed, or does not match [due].
     */
    internal fun readSensors(frame: ByteBuffer, position: Int, due: IntList) {
        answers.begin(due)
        if (position == 0) {
            if (due.size == 0) return
            throw MalformedFrameException("sensor data is missing, but ${due.size} nodes are due")
        }
        reader.attach(frame, position)
        reader.check()
        if (reader.size != due.size) throw MalformedFrameException("sensor data has ${reader.size} elements, but ${due.size} nodes are due")
    }

    /**
     * Verifies and copies the table `GlobalData` at [position] of [frame]. Returns a view of the copy, or `null` if the position is 0.
     *
     * @throws MalformedFrameException when the data is malformed, or the schema does not define `GlobalData`.
     */
    internal fun readGlobals(frame: ByteBuffer, position: Int): Any? {
        if (position == 0) return null
        val holder =
            globals ?: throw MalformedFrameException("the frame contains global data, but schema ${schema.name} does not define GlobalData")
        return holder.read(frame, position)
    }

    /** Makes the global data of [tick], if any, current. Call it once the tick is accepted. */
    public fun accept(tick: Tick) {
        if (tick.globals != null) globals?.accept()
    }

    override fun sensors(worker: Int, index: Int): Any = views[worker].at(reader.place(index), reader.frame)

    /** Returns the sensor data of the node `due[index]` in a new view, valid as long as the frame. */
    public fun snapshot(index: Int): Any = schema.sensorView().at(reader.place(index), reader.frame)

    override fun pack(worker: Int, index: Int, answer: Any): String? = answers.pack(worker, index, answer)
}
