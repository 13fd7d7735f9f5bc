package org.collektive.tools.record

import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.data.ReflectionReader
import org.collektive.host.programs.JarBytes
import java.nio.ByteBuffer

/**
 * Reads the user data of a record by the binary schema in its jars. Runs no code of the jars: a record may come from anybody.
 *
 * @throws MalformedFrameException when the schema is damaged.
 */
internal class RecordedTypes(private val reflection: ReflectionReader, namespace: String) {
    private val sensors = Elements("$namespace.SensorData")
    private val actuators = Elements("$namespace.ActuatorData")
    private val globalType = "$namespace.GlobalData"
    private val globals = if (reflection.defines(globalType)) reflection.table(globalType) else null
    private val checker = FrameChecker(FramePolicy.USER_DATA)

    /** The sensor data of the table `Sensors` at [position] of [frame], by node. */
    fun sensors(frame: ByteBuffer, position: Int, count: Int, node: (Int) -> Int): Map<Int, Any> =
        sensors.read(frame, position, count, node)

    /** The actuator data of the table `Actuators` at [position] of [frame], by node. */
    fun actuators(frame: ByteBuffer, position: Int, count: Int, node: (Int) -> Int): Map<Int, Any> =
        actuators.read(frame, position, count, node)

    /** The `GlobalData` at [position] of [frame]; `null` when there is none. */
    fun globals(frame: ByteBuffer, position: Int): Any? {
        if (position == 0 || globals == null) return null
        checker.check(frame, position, globals)
        return reflection.read(globalType, frame, position)
    }

    private inner class Elements(private val type: String) {
        private val reader = reflection.elements(type)

        fun read(frame: ByteBuffer, position: Int, count: Int, node: (Int) -> Int): Map<Int, Any> {
            if (position == 0) return emptyMap()
            reader.attach(frame, position)
            reader.check()
            if (reader.size != count) throw MalformedFrameException("there are data of ${reader.size} nodes for $count")
            return (0 until count).associate { node(it) to reflection.read(type, frame, reader.place(it)) }
        }
    }

    companion object {
        /**
         * The types of the [schema] in one of the [jars].
         *
         * @throws RecordRefused when none has them, or they are damaged.
         */
        fun of(schema: String, jars: List<JarBytes>): RecordedTypes {
            val entry = ReflectionReader.entry(schema)
            val binary = jars.firstNotNullOfOrNull { it.entry(entry) }
                ?: throw RecordRefused("none of ${jars.map(JarBytes::path)} holds $entry: generate the code of the schema anew")
            return try {
                RecordedTypes(ReflectionReader(binary), schema.substringBeforeLast('.'))
            } catch (e: MalformedFrameException) {
                throw RecordRefused("$entry is damaged: ${e.message}")
            }
        }
    }
}
