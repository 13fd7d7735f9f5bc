package org.collektive.tools.record

import com.google.flatbuffers.FlatBufferBuilder
import org.collektive.frames.data.GeneratedCode
import org.collektive.frames.data.ReflectionReader
import org.collektive.host.programs.JarBytes
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import java.io.ByteArrayOutputStream
import java.nio.file.Path
import java.util.zip.ZipEntry
import java.util.zip.ZipOutputStream
import kotlin.io.path.readBytes
import kotlin.io.path.writeText
import kotlin.test.assertEquals

class RecordedTypesTest {
    @field:TempDir
    lateinit var folder: Path

    @Test
    fun `global data is read even if it is in another namespace than sensor data`() {
        val schema = folder.resolve("split.fbs")
        schema.writeText(
            """
            namespace weather;
            table GlobalData { wind: float; }
            namespace swarm;
            struct SensorData { value: int; }
            struct ActuatorData { value: int; }
            """,
        )
        GeneratedCode.generate(schema, folder)
        val types = RecordedTypes.of("swarm.SplitSchema", listOf(jar(ReflectionReader.entry("swarm.SplitSchema"))))
        val builder = FlatBufferBuilder()
        builder.startTable(1)
        builder.addFloat(0, 2.5f, 0.0)
        builder.finish(builder.endTable())
        val frame = builder.dataBuffer()
        assertEquals(mapOf<String, Any?>("wind" to 2.5f), types.globals(frame, frame.position() + frame.getInt(frame.position())))
    }

    /** Returns a jar of the file [entry]. */
    private fun jar(entry: String): JarBytes {
        val bytes = ByteArrayOutputStream()
        ZipOutputStream(bytes).use { zip ->
            zip.putNextEntry(ZipEntry(entry))
            zip.write(folder.resolve(entry).readBytes())
        }
        return JarBytes("split.jar", bytes.toByteArray())
    }
}
