package org.collektive.frames.data

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.frames.MalformedFrameException
import java.nio.ByteBuffer

/**
 * One user schema as the host sees it: how to read sensors and write actuators whose fields only generated code knows.
 *
 * Implemented by generated Java and found by [java.util.ServiceLoader] in a programs' jar. Instances are stateless.
 */
public interface DataSchema {
    /** Name of the schema, equal to that of the C# side. */
    public val name: String

    /** Fingerprints of `SensorData`, `ActuatorData` and, where defined, `GlobalData`, nested types included. */
    public val types: Map<String, Long>

    /** The reader class that programs take (`SensorData`). */
    public val sensorType: Class<*>

    /** The object class that programs return (`ActuatorDataT`). */
    public val actuatorType: Class<*>

    /** Makes a reader of the table `Sensors`; each belongs to one thread at a time. */
    public fun sensorReader(): DataReader

    /** Makes a reader of the table `Actuators`; each belongs to one thread at a time. */
    public fun actuatorReader(): DataReader

    /** Makes a writer; each belongs to one thread at a time. */
    public fun actuatorWriter(): ActuatorWriter

    /** Makes a reader of global data, or `null` when the schema defines none. */
    public fun globalReader(): GlobalReader?
}

/** Reads the table `Sensors` or `Actuators` of a frame in place; allocates nothing after its construction. */
public interface DataReader {
    /**
     * Points this reader at the table at [position] (bytes from the start of the buffer) of [frame]; little-endian. The frame
     * is what lies between the buffer's position and limit.
     *
     * @throws MalformedFrameException when the table or its vector lies outside of the frame.
     */
    public fun attach(frame: ByteBuffer, position: Int)

    /** Points this reader, without another check, at the table that [checked] is attached to: a reader of the same kind that passed [check]. */
    public fun follow(checked: DataReader)

    /** Elements in the attached table. */
    public val size: Int

    /**
     * Checks that every element, nested tables, vectors and strings included, lies inside the frame. Reading what passed
     * never throws.
     *
     * @throws MalformedFrameException naming the element and the field that does not.
     */
    public fun check()

    /** The data of element [index]: a view, the same object at every call, valid until the next one. */
    public operator fun get(index: Int): Any
}

/** Writes the table `Actuators` of a frame. */
public interface ActuatorWriter {
    /**
     * What makes a program's result impossible to write, its path first (`target is null`), or `null` when nothing does. Ask
     * after each round: a result with a fault would spoil the whole answer.
     */
    public fun findFault(result: Any?): String?

    /** Bytes of a result that is a struct; 0 when results are tables, which vary. */
    public val structBytes: Int

    /** Writes the struct [result], which has no fault, into [target] from [offset] on. */
    public fun pack(result: Any, target: ByteArray, offset: Int)

    /** Writes the first [count] structs that lie side by side in [packed], little-endian, and returns the table's offset for [builder]. */
    public fun writePacked(builder: FlatBufferBuilder, packed: ByteBuffer, count: Int): Int

    /**
     * Writes [results] `0 until count` in this order and returns the table's offset for [builder]. None may have a fault.
     *
     * `ranges[2 * i]` gets the distance of element i's first byte from the *end* of the builder's buffer and
     * `ranges[2 * i + 1]` its length in bytes, for the digest.
     */
    public fun write(builder: FlatBufferBuilder, results: Array<Any?>, count: Int, ranges: IntArray): Int
}

/** Reads the table `GlobalData` of a frame in place. */
public interface GlobalReader {
    /** Points this reader at the table at [position] of [frame], which stays unchanged while [data] is in use. */
    public fun attach(frame: ByteBuffer, position: Int)

    /** Like [DataReader.check]. */
    public fun check()

    /** The `GlobalData` view. */
    public val data: Any
}
