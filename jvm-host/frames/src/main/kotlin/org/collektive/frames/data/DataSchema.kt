package org.collektive.frames.data

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.frames.MalformedFrameException
import java.nio.ByteBuffer

/**
 * A user's schema: makes readers of its sensor data and writers of its actuator data.
 *
 * Generated Java implements it; [java.util.ServiceLoader] finds it in the jar of the programs. Stateless, so safe on any thread.
 */
public interface DataSchema {
    /** Name of the schema, the same on the C# side. */
    public val name: String

    /** Fingerprints of `SensorData`, `ActuatorData` and, if defined, `GlobalData`; they cover nested types. */
    public val types: Map<String, Long>

    /** The class of the parameter of programs (`SensorData`). */
    public val sensorType: Class<*>

    /** The class of the result of programs (`ActuatorDataT`). */
    public val actuatorType: Class<*>

    /** Makes a reader of the table `Sensors`, for one thread at a time. */
    public fun sensorReader(): DataReader

    /** Makes a reader of the table `Actuators`, for one thread at a time. */
    public fun actuatorReader(): DataReader

    /** Makes a writer of the table `Actuators`, for one thread at a time. */
    public fun actuatorWriter(): ActuatorWriter

    /** Makes a reader of the table `GlobalData`; `null` when the schema defines none. */
    public fun globalReader(): GlobalReader?
}

/** Reads the table `Sensors` or `Actuators` of a frame in place. Allocates only in its constructor. Confined to one thread at a time. */
public interface DataReader {
    /**
     * Attaches this reader to the table at [position] of [frame], in bytes from the start of the buffer. The frame is what lies between
     * the buffer's position and limit; the buffer must be little-endian.
     *
     * @throws MalformedFrameException when the table or its vector lies outside the frame.
     */
    public fun attach(frame: ByteBuffer, position: Int)

    /** Attaches this reader, without a check, to the table of [checked]: a reader from the same factory that passed [check]. */
    public fun follow(checked: DataReader)

    /** Number of elements in the attached table. */
    public val size: Int

    /**
     * Checks that every element lies inside the frame, with its nested tables, vectors and strings. Reading checked elements never
     * throws.
     *
     * @throws MalformedFrameException when one does not; the message names the element and the field.
     */
    public fun check()

    /** A view of element [index]. Each call returns the same object, so a view is valid until the next call. */
    public operator fun get(index: Int): Any
}

/** Writes the table `Actuators` of a frame. Confined to one thread at a time. */
public interface ActuatorWriter {
    /**
     * The reason why [result] cannot be written, preceded by the path of the field (`target is null`); `null` when it can. Check each
     * result after its round: one faulty result would corrupt the whole answer.
     */
    public fun findFault(result: Any?): String?

    /** Size of a result in bytes if results are structs; 0 if they are tables, whose size varies. */
    public val structBytes: Int

    /** Writes the struct [result] to [target] at [offset]. It must have no fault. */
    public fun pack(result: Any, target: ByteArray, offset: Int)

    /** Writes the first [count] structs of [packed], which is contiguous and little-endian. Returns the table's offset in [builder]. */
    public fun writePacked(builder: FlatBufferBuilder, packed: ByteBuffer, count: Int): Int

    /**
     * Writes the first [count] of [results], in order, and returns the table's offset in [builder]. None may have a fault.
     *
     * Fills [ranges] for the digest: `ranges[2 * i]` is the distance of the first byte of element i from the *end* of the builder's
     * buffer, `ranges[2 * i + 1]` its length, both in bytes.
     */
    public fun write(builder: FlatBufferBuilder, results: Array<Any?>, count: Int, ranges: IntArray): Int
}

/** Reads the table `GlobalData` of a frame in place. */
public interface GlobalReader {
    /** Attaches this reader to the table at [position] of [frame]. The frame must not change while [data] is in use. */
    public fun attach(frame: ByteBuffer, position: Int)

    /** Like [DataReader.check]. */
    public fun check()

    /** A view of the data, of type `GlobalData`. */
    public val data: Any
}
