package org.collektive.tools.record

import org.collektive.frame.OpenRequest
import org.collektive.frames.MalformedFrameException
import org.collektive.frames.session.openRequest
import org.collektive.frames.tick.StepResponseReader
import org.collektive.host.programs.JarBytes
import org.collektive.host.record.Chunk
import org.collektive.host.record.RecordWriter
import java.io.IOException
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.nio.channels.FileChannel
import java.nio.file.Files
import java.nio.file.NoSuchFileException
import java.nio.file.Path
import java.nio.file.StandardOpenOption.READ
import java.util.zip.CRC32

/** Reads a record: first how its session was opened, then its steps in order. */
internal class Record private constructor(private val path: Path, private val channel: FileChannel) : AutoCloseable {
    private val size = channel.size()
    private val crc = CRC32()
    private var offset = 0L

    /** The last tick read completely; 0 before the first. */
    var tick = 0L
        private set

    /** The properties of the recording side, one per line. */
    val head: String

    /** The session's `OpenRequest`, between position and limit. */
    val open: ByteBuffer

    /** Accessor of [open]. */
    val settings: OpenRequest

    /** The session's jars, as they were when recorded. */
    val jars: List<JarBytes>

    init {
        readMagic()
        head = text(expect(Chunk.HEAD))
        val chunk = expect(Chunk.OPEN)
        open = chunk.payload
        settings = verified(chunk) { openRequest(open) }
        jars = List(settings.jarsLength()) { jar(expect(Chunk.JAR)) }
    }

    /**
     * The next step; `null` after the last.
     *
     * @throws RecordDamaged when the step cannot be read.
     */
    fun next(): RecordedStep? {
        val step = chunk()
        if (step.kind == Chunk.END) {
            if (offset != size) throw damaged(offset, "something follows the record's end")
            return null
        }
        if (step.kind != Chunk.STEP) throw damaged(step.offset, "a chunk ${step.name} stands where a step or the end must come")
        val outcome = chunk()
        return when (outcome.kind) {
            Chunk.FAIL -> RecordedStep(step.payload, null, text(outcome))

            Chunk.DONE -> {
                val answer = verified(outcome) { StepResponseReader(outcome.payload) }
                tick = answer.response.tick()
                RecordedStep(step.payload, answer, null)
            }

            else -> throw damaged(outcome.offset, "a chunk ${outcome.name} stands where a step's outcome must come")
        }
    }

    /** Bytes read so far, and size of the file in bytes. */
    val progress: Pair<Long, Long> get() = offset to size

    override fun close() {
        channel.close()
    }

    private fun readMagic() {
        val magic = read(minOf(size, RecordWriter.MAGIC.size.toLong()).toInt()).array()
        val name = RecordWriter.MAGIC_TEXT.encodeToByteArray()
        if (magic.size < RecordWriter.MAGIC.size || !magic.copyOf(name.size).contentEquals(name)) {
            throw RecordRefused("$path is not a record of frames: it does not begin with '${RecordWriter.MAGIC_TEXT}'")
        }
        val version = (magic[name.size].toInt() and 0xFF) or (magic[name.size + 1].toInt() and 0xFF shl 8)
        if (version != RecordWriter.VERSION.toInt()) {
            throw RecordRefused(
                "$path is a record of version $version, and this release reads version ${RecordWriter.VERSION}: use the release that wrote it",
            )
        }
    }

    private fun expect(kind: Int): Chunk = chunk().also {
        if (it.kind != kind) throw damaged(it.offset, "a chunk ${it.name} stands where ${Chunk.name(kind)} must come")
    }

    private fun chunk(): Chunk {
        val begin = offset
        if (begin == size) throw damaged(begin, "the file ends without the record's end: the run was killed, or the file was cut")
        if (size - begin < Chunk.HEADER_BYTES) throw damaged(begin, "the file ends inside a chunk's header")
        val header = read(Chunk.HEADER_BYTES)
        val kind = header.getInt()
        val length = header.getInt().toLong() and UINT
        if (length > size - offset) throw damaged(begin, "the chunk wants $length bytes, and the file has ${size - offset} more")
        if (length > Int.MAX_VALUE) throw damaged(begin, "the chunk wants $length bytes, more than a frame can have")
        val payload = try {
            read(length.toInt())
        } catch (_: OutOfMemoryError) {
            throw damaged(begin, "the chunk wants $length bytes, more than there is memory for")
        }
        if (header.getInt() != Chunk.checksum(crc, header, payload)) throw damaged(begin, "the chunk's checksum does not fit its bytes")
        return Chunk(kind, begin, payload)
    }

    private fun read(length: Int): ByteBuffer {
        val bytes = ByteBuffer.allocate(length).order(ByteOrder.LITTLE_ENDIAN)
        while (bytes.hasRemaining()) {
            val count = channel.read(bytes, offset + bytes.position())
            if (count < 0) throw damaged(offset + bytes.position(), "the file became shorter while it was read")
        }
        offset += length
        return bytes.flip()
    }

    private fun jar(chunk: Chunk): JarBytes {
        val payload = chunk.payload
        val nameLength = if (payload.remaining() < Int.SIZE_BYTES) -1 else payload.getInt()
        if (nameLength !in 0..payload.remaining()) throw damaged(chunk.offset, "the jar's name lies outside of its chunk")
        val name = ByteArray(nameLength).also(payload::get)
        return JarBytes(name.decodeToString(), ByteArray(payload.remaining()).also(payload::get))
    }

    private fun text(chunk: Chunk): String = Charsets.UTF_8.decode(chunk.payload.duplicate()).toString()

    private inline fun <T> verified(chunk: Chunk, read: () -> T): T = try {
        read()
    } catch (e: MalformedFrameException) {
        throw damaged(chunk.offset, "the frame is damaged: ${e.message}")
    }

    private fun damaged(at: Long, what: String) =
        RecordDamaged("$path is damaged at byte $at, ${if (tick == 0L) "before the first tick" else "after tick $tick"}: $what")

    companion object {
        private const val UINT = 0xFFFF_FFFFL

        /**
         * Opens the record at [path].
         *
         * @throws RecordRefused when the file is no record, or a record of another version.
         * @throws RecordDamaged when the part before the first step is damaged.
         */
        fun open(path: Path): Record {
            // Opening a pipe would wait for its other end.
            if (Files.exists(path) && !Files.isRegularFile(path)) throw RecordRefused("$path is no file: name a record")
            val channel = try {
                FileChannel.open(path, READ)
            } catch (_: NoSuchFileException) {
                throw RecordRefused("there is no record $path; correct the path, or make one with the scenario's outputs.record")
            } catch (e: IOException) {
                throw RecordRefused("the record $path cannot be read: $e")
            }
            return try {
                Record(path, channel)
            } catch (e: IOException) {
                channel.close()
                throw RecordRefused("the record $path cannot be read: $e")
            } catch (e: RuntimeException) {
                channel.close()
                throw e
            }
        }
    }
}

/** A recorded step: its `StepRequest`, and either the answer or the reason why there is none. */
internal class RecordedStep(val request: ByteBuffer, val answer: StepResponseReader?, val failure: String?)

/** A record cannot be used, or not to its end; [message] says why, where, and what to do. */
internal sealed class RecordException(message: String) : RuntimeException(message)

/** A file is no record, or no record for this command. */
internal class RecordRefused(message: String) : RecordException(message)

/** A record is damaged from some byte on. */
internal class RecordDamaged(message: String) : RecordException(message)
