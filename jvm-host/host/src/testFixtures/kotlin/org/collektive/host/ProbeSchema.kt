package org.collektive.host

import com.google.flatbuffers.Table
import org.collektive.frame.Opaque
import org.collektive.frames.data.DataSchema
import org.collektive.host.programs.JarBytes
import org.collektive.host.programs.ProgramJar
import org.collektive.host.programs.ProgramLoader
import java.nio.ByteBuffer
import java.nio.file.Path
import java.util.ServiceLoader

/** Access to the probe's generated code, which is not on the class path of the tests. */
internal object ProbeSchema {
    /** Fingerprints as C# sends them. */
    val types: Map<String, Long> by lazy { types("probe.ProbeSchema", ProbeJars.programs) }

    /** Fingerprints of any schema of a jar. */
    fun types(schema: String, jar: Path): Map<String, Long> {
        val loader = ProgramLoader(listOf(ProgramJar.open(JarBytes.read(jar.toString()))))
        return ServiceLoader.load(DataSchema::class.java, loader).single { it.name == schema }.types
    }

    /** Value and text of element [index] of the table `Actuators`. */
    fun actuator(actuators: Opaque, index: Int): Pair<Long, String?> = Actuators(actuators).element(index)

    /** Reads a table as generated code does. */
    private class Actuators(opaque: Opaque) : Table() {
        init {
            __reset(POSITION.getInt(opaque), opaque.byteBuffer)
        }

        fun element(index: Int): Pair<Long, String?> {
            val element = Element(__indirect(__vector(__offset(4)) + index * 4), bb)
            return element.value to element.text
        }
    }

    private class Element(position: Int, buffer: ByteBuffer) : Table() {
        init {
            __reset(position, buffer)
        }

        val value: Long get() = __offset(4).let { if (it == 0) 0 else bb.getLong(it + bb_pos) }
        val text: String? get() = __offset(6).let { if (it == 0) null else __string(it + bb_pos) }
    }

    /** The position in the frame, a protected field of [Table]. */
    private val POSITION = Table::class.java.getDeclaredField("bb_pos").apply { isAccessible = true }
}
