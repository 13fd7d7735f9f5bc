package gradientascent

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.schema.Vector3
import org.collektive.schema.Vector3Value

/** Returns the sensor data of a node at [position]. */
internal fun sensors(intensity: Float, position: Vector3Value, vararg obstacles: Vector3Value): SensorData {
    val builder = FlatBufferBuilder()
    SensorData.startObstaclesVector(builder, obstacles.size)
    for (obstacle in obstacles.reversed()) Vector3.createVector3(builder, obstacle.x, obstacle.y, obstacle.z)
    val vector = builder.endVector()
    SensorData.startSensorData(builder)
    SensorData.addIntensity(builder, intensity)
    SensorData.addPosition(builder, Vector3.createVector3(builder, position.x, position.y, position.z))
    SensorData.addObstacles(builder, vector)
    builder.finish(SensorData.endSensorData(builder))
    return SensorData.getRootAsSensorData(builder.dataBuffer())
}
