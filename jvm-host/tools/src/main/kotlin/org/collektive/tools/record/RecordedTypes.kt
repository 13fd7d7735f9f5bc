package org.collektive.tools.record

import org.collektive.frames.FrameChecker
import org.collektive.frames.FramePolicy
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.data.ReflectionReader
import org.collektive.host.programs.JarBytes
import java.nio.ByteBuffer

/**
 * Reads the user data of a record with the binary schema in its jars. Does not run the code of the jars, because records are untrusted.
 *
 * @throws MalformedFrameException when the schema is damaged.
 */
internal class RecordedTypes(private val reflection: ReflectionReader, namespace: String) {
    private val sensors = Elements("$namespace.SensorData")
    private val actuators = Elements("$namespace.ActuatorData")

    // Unlike the other types, this one can be in another namespace.
    private val globalType = reflection.find("GlobalData")
    private val globals = globalType?.let(reflection::table)
    private val checker = FrameChecker(FramePolicy.USER_DATA)

    /** Returns the sensor data of the table `Sensors` at [position] of [frame], by node. */
    fun sensors(frame: ByteBuffer, position: Int, count: Int, node: (Int) -> Int): Map<Int, Any> =
        sensors.read(frame, position, count, node)

    /** Returns the actuator data of the table `Actuators` at [position] of [frame], by node. */
    fun actuators(frame: ByteBuffer, position: Int, count: Int, node: (Int) -> Int): Map<Int, Any> =
        actuators.read(frame, position, count, node)

    /** Returns the `GlobalData` at [position] of [frame], or `null` if it is absent. */
    fun globals(frame: ByteBuffer, position: Int): Any? {
        if (position == 0 || globalType == null || globals == null) return null
        checker.check(frame, position, globals)
        return reflection.read(globalType, frame, position)
    }

    private inner class Elements(private val type: String) {
        private val reader = reflection.elements(type)

        fun read(frame: ByteBuffer, position: Int, count: Int, node: (Int) -> Int): Map<Int, Any> {
            if (position == 0) return emptyMap()
            reader.attach(frame, position)
            reader.check()
            if (reader.size != count) throw MalformedFrameException("the data has ${reader.size} elements for $count nodes")
            return (0 until count).associate { node(it) to reflection.read(type, frame, reader.place(it)) }
        }
    }

    companion object {
        /**
         * Returns the types of the [schema], which one of the [jars] contains.
         *
         * @throws InvalidRecordException when they are missing or damaged.
         */
        fun of(schema: String, jars: List<JarBytes>): RecordedTypes {
            val entry = ReflectionReader.entry(schema)
            val binary = jars.firstNotNullOfOrNull { it.entry(entry) }
                ?: throw InvalidRecordException(
                    "none of ${jars.map(JarBytes::path)} contains $entry: generate the code of the schema again and rebuild the jar",
                )
            return try {
                RecordedTypes(ReflectionReader(binary), schema.substringBeforeLast('.'))
            } catch (e: MalformedFrameException) {
                throw InvalidRecordException("$entry is damaged: ${e.message}")
            }
        }
    }
}
