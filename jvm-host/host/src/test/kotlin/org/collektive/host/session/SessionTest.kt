package org.collektive.host.session

import org.collektive.engine.RoundThread
import org.collektive.frame.OpenRequest
import org.collektive.host.ProbeJars
import org.collektive.host.TestShim
import org.collektive.host.openFrame
import org.collektive.host.programs.JarBytes
import org.collektive.host.record.RecordWriter
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import org.junit.jupiter.api.io.TempDir
import java.io.IOException
import java.net.URI
import java.nio.ByteBuffer
import java.nio.channels.GatheringByteChannel
import java.nio.file.FileSystems
import java.nio.file.Path
import kotlin.io.path.copyTo
import kotlin.io.path.readBytes
import kotlin.io.path.writeBytes
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Tests that sessions release their resources even if opening or closing fails. */
@Timeout(60)
class SessionTest {
    private val shim = TestShim()
    private val channel = Channel()

    @TempDir
    lateinit var folder: Path

    /** A channel to a file on a full disk. */
    private class Channel : GatheringByteChannel {
        var open = true

        override fun write(source: ByteBuffer?): Int = throw IOException("disk full")

        override fun write(sources: Array<out ByteBuffer>?): Long = throw IOException("disk full")

        override fun write(sources: Array<out ByteBuffer>?, offset: Int, length: Int): Long = throw IOException("disk full")

        override fun isOpen() = open

        override fun close() {
            open = false
            throw IOException("still full")
        }
    }

    @Test
    fun `a session whose record cannot be closed is closed`() {
        val session = open(ProbeJars.programs) { RecordWriter("full.rec", channel) }
        session.close()
        assertFalse(channel.open)
        val (_, message) = shim.logs.single()
        assertContains(message, "cannot write the record full.rec")
        assertContains(message, "disk full")
    }

    @Test
    fun `if a session cannot be created, its record is closed and its threads end`() {
        val jar = folder.resolve("broken.jar")
        ProbeJars.programs.copyTo(jar)
        FileSystems.newFileSystem(URI.create("jar:${jar.toUri()}"), emptyMap<String, Any>()).use { zip ->
            val schema = zip.getPath("probe/ProbeSchema.class")
            val broken = schema.readBytes().toString(Charsets.ISO_8859_1).replace("sensorView", "sensorVieX")
            schema.writeBytes(broken.toByteArray(Charsets.ISO_8859_1))
        }
        val before = rounds()
        lateinit var during: Set<Thread>
        val record = folder.resolve("session.rec").toString()
        lateinit var writer: RecordWriter
        assertFailsWith<AbstractMethodError> {
            open(jar) {
                during = rounds() - before
                RecordWriter.create(record, ByteBuffer.allocate(0), emptyList()).also { writer = it }
            }
        }
        assertFailsWith<IOException> { writer.end() }
        assertEquals(2, during.size)
        during.forEach(Thread::join)
    }

    @Test
    fun `if a record cannot be created, the session's threads end`() {
        val before = rounds()
        lateinit var during: Set<Thread>
        assertFailsWith<IllegalStateException> {
            open(ProbeJars.programs) {
                during = rounds() - before
                error("no record")
            }
        }
        assertTrue(during.isNotEmpty())
        during.forEach(Thread::join)
    }

    private fun open(jar: Path, record: () -> RecordWriter?): Session {
        val request = OpenRequest.getRootAsOpenRequest(openFrame(listOf(jar.toString())))
        return SessionOpening.open(request, listOf(JarBytes.read(jar.toString())), shim, record = record)
    }

    private fun rounds(): Set<Thread> = Thread.getAllStackTraces().keys.filterTo(HashSet()) { it is RoundThread }
}
