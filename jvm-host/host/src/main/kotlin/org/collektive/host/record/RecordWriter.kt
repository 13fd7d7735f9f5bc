package org.collektive.host.record

import org.collektive.host.jvm.jvmFlag
import org.collektive.host.programs.JarBytes
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import java.io.IOException
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.nio.channels.FileChannel
import java.nio.channels.GatheringByteChannel
import java.nio.file.InvalidPathException
import java.nio.file.Path
import java.nio.file.StandardOpenOption.CREATE
import java.nio.file.StandardOpenOption.TRUNCATE_EXISTING
import java.nio.file.StandardOpenOption.WRITE
import java.util.zip.CRC32

/**
 * Writes a session's frames to a file, directly from their memory. Allocates nothing per tick. Not thread-safe.
 *
 * A request is written before its tick runs, so the record also contains a tick that never ends. Functions throw [IOException] when the
 * file cannot be written.
 */
public class RecordWriter internal constructor(private val path: String, private val channel: GatheringByteChannel) : AutoCloseable {
    private val header = ByteBuffer.allocateDirect(Chunk.HEADER_BYTES).order(ByteOrder.LITTLE_ENDIAN)
    private val parts = arrayOf(header, header)
    private val crc = CRC32()

    /** Whether [end] has written the whole record. */
    public var isComplete: Boolean = false
        private set

    /** Writes the `StepRequest` between position and limit of [frame]. */
    public fun step(frame: ByteBuffer): Unit = write(Chunk.STEP, frame)

    /** Writes the jars that the last step loads. */
    public fun jars(jars: List<JarBytes>) {
        for (jar in jars) {
            val name = jar.path.encodeToByteArray()
            val payload = ByteBuffer.allocate(Int.SIZE_BYTES + name.size + jar.bytes.size).order(ByteOrder.LITTLE_ENDIAN)
            write(Chunk.JAR, payload.putInt(name.size).put(name).put(jar.bytes).flip())
        }
    }

    /** Writes the `StepResponse` between position and limit of [frame]. */
    public fun done(frame: ByteBuffer): Unit = write(Chunk.DONE, frame)

    /** Writes the reason why the last step failed. */
    public fun failed(why: String): Unit = write(Chunk.FAIL, text(why))

    /** Writes the end of a session that was closed normally, and closes the file. */
    public fun end() {
        write(Chunk.END, NOTHING)
        close()
        isComplete = true
    }

    override fun close() {
        channel.close()
    }

    /** Returns the user's message about a failed write. */
    public fun failure(cause: IOException): String =
        "cannot write the record $path ($cause): free disk space or choose another path, then restart the simulation"

    private fun head(open: ByteBuffer, jars: List<JarBytes>) {
        header.clear().put(MAGIC).flip()
        while (header.hasRemaining()) channel.write(header)
        // The setting Repeatable maths changes results of `Math`.
        val maths = if (jvmFlag("UseLibmIntrinsic") == "false") "maths=repeatable\n" else ""
        write(Chunk.HEAD, text("java=${Runtime.version()}\nos=${System.getProperty("os.name")} ${System.getProperty("os.arch")}\n$maths"))
        write(Chunk.OPEN, open)
        jars(jars)
    }

    private fun write(kind: Int, payload: ByteBuffer) {
        val begin = payload.position()
        header.clear().putInt(kind).putInt(payload.remaining())
        header.putInt(Chunk.checksum(crc, header, payload)).flip()
        parts[1] = payload
        while (header.hasRemaining() || payload.hasRemaining()) channel.write(parts)
        payload.position(begin)
    }

    private fun text(text: String) = ByteBuffer.wrap(text.encodeToByteArray())

    public companion object {
        /** Version of the format. */
        public const val VERSION: Short = 1

        /** Name of the format. */
        public const val MAGIC_TEXT: String = "CLKREC"

        /** The first bytes of a record: name and version of the format. */
        public val MAGIC: ByteArray get() = MAGIC_TEXT.encodeToByteArray() + byteArrayOf(VERSION.toByte(), 0)

        private val NOTHING = ByteBuffer.allocate(0)

        /**
         * Creates the record [path] of a session; overwrites an existing file.
         *
         * @param open the session's `OpenRequest`, between position and limit.
         * @param jars the session's programs.
         * @throws HostException when the file cannot be written.
         */
        public fun create(path: String, open: ByteBuffer, jars: List<JarBytes>): RecordWriter {
            try {
                val writer = RecordWriter(path, FileChannel.open(Path.of(path), CREATE, WRITE, TRUNCATE_EXISTING))
                try {
                    writer.head(open, jars)
                } catch (e: IOException) {
                    writer.close()
                    throw e
                }
                return writer
            } catch (e: IOException) {
                throw HostException(HostError.ARGUMENT, "cannot create the record $path: $e; choose another path", e)
            } catch (e: InvalidPathException) {
                throw HostException(HostError.ARGUMENT, "'$path' is not a valid path of a record; correct it", e)
            }
        }
    }
}
