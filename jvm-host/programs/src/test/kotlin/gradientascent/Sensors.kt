package gradientascent

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.schema.Vector3T

/** A vector in metres. */
internal fun vector(x: Float, y: Float, z: Float) = Vector3T().also {
    it.x = x
    it.y = y
    it.z = z
}

/** The sensor data of a node at [position]. */
internal fun sensors(intensity: Float, position: Vector3T, vararg obstacles: Vector3T): SensorData {
    val builder = FlatBufferBuilder()
    val data = SensorDataT()
    data.intensity = intensity
    data.position = position
    data.obstacles = arrayOf(*obstacles)
    builder.finish(SensorData.pack(builder, data))
    return SensorData.getRootAsSensorData(builder.dataBuffer())
}
