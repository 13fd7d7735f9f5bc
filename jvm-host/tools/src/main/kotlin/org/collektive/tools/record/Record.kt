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

/** Reads a record: first the settings of its session, then its steps in order. */
internal class Record private constructor(private val path: Path, private val channel: FileChannel) : AutoCloseable {
    private val size = channel.size()
    private val crc = CRC32()
    private var offset = 0L

    /** The last complete tick; 0 before the first. */
    var tick = 0L
        private set

    /** Properties of the machine that wrote the record, one per line. */
    val head: String

    /** The session's `OpenRequest`, between position and limit. */
    val open: ByteBuffer

    /** The settings in [open]. */
    val settings: OpenRequest

    /** The jars of the session at the time of the recording. */
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
     * Returns the next step, or `null` after the last one.
     *
     * @throws DamagedRecordException when the step cannot be read.
     */
    fun next(): RecordedStep? {
        val step = chunk()
        if (step.kind == Chunk.END) {
            if (offset != size) throw damaged(offset, "unexpected data after the end of the record")
            return null
        }
        if (step.kind != Chunk.STEP) throw damaged(step.offset, "found a chunk ${step.name}, but expected a step or the end")
        val jars = ArrayList<JarBytes>(0)
        var outcome = chunk()
        while (outcome.kind == Chunk.JAR) {
            jars += jar(outcome)
            outcome = chunk()
        }
        return when (outcome.kind) {
            Chunk.FAIL -> RecordedStep(step.payload, jars, null, text(outcome))

            Chunk.DONE -> {
                val answer = verified(outcome) { StepResponseReader(outcome.payload) }
                tick = answer.response.tick()
                RecordedStep(step.payload, jars, answer, null)
            }

            else -> throw damaged(outcome.offset, "found a chunk ${outcome.name}, but expected the outcome of a step")
        }
    }

    /** The number of bytes read so far, and the size of the file in bytes. */
    val progress: Pair<Long, Long> get() = offset to size

    override fun close() {
        channel.close()
    }

    private fun readMagic() {
        val magic = read(minOf(size, RecordWriter.MAGIC.size.toLong()).toInt()).array()
        val name = RecordWriter.MAGIC_TEXT.encodeToByteArray()
        if (magic.size < RecordWriter.MAGIC.size || !magic.copyOf(name.size).contentEquals(name)) {
            throw InvalidRecordException("$path is not a record: it does not start with '${RecordWriter.MAGIC_TEXT}'")
        }
        val version = (magic[name.size].toInt() and 0xFF) or (magic[name.size + 1].toInt() and 0xFF shl 8)
        if (version != RecordWriter.VERSION.toInt()) {
            throw InvalidRecordException(
                "$path has record version $version, but this release reads version ${RecordWriter.VERSION}: use the release that wrote it",
            )
        }
    }

    private fun expect(kind: Int): Chunk = chunk().also {
        if (it.kind != kind) throw damaged(it.offset, "found a chunk ${it.name}, but expected ${Chunk.name(kind)}")
    }

    private fun chunk(): Chunk {
        val begin = offset
        if (begin == size) throw damaged(begin, "the end of the record is missing: the run was killed, or the file was truncated")
        if (size - begin < Chunk.HEADER_BYTES) throw damaged(begin, "the file ends in the header of a chunk")
        val header = read(Chunk.HEADER_BYTES)
        val kind = header.getInt()
        val length = header.getInt().toLong() and UINT
        if (length > size - offset) throw damaged(begin, "the chunk has $length bytes, but the file contains only ${size - offset} more")
        if (length > Int.MAX_VALUE) throw damaged(begin, "the chunk has $length bytes, more than the maximum size of a frame")
        val payload = try {
            read(length.toInt())
        } catch (_: OutOfMemoryError) {
            throw damaged(begin, "the chunk has $length bytes, which do not fit into memory")
        }
        if (header.getInt() != Chunk.checksum(crc, header, payload)) throw damaged(begin, "the checksum of the chunk is wrong")
        return Chunk(kind, begin, payload)
    }

    private fun read(length: Int): ByteBuffer {
        val bytes = ByteBuffer.allocate(length).order(ByteOrder.LITTLE_ENDIAN)
        while (bytes.hasRemaining()) {
            val count = channel.read(bytes, offset + bytes.position())
            if (count < 0) throw damaged(offset + bytes.position(), "the file was truncated while it was read")
        }
        offset += length
        return bytes.flip()
    }

    private fun jar(chunk: Chunk): JarBytes {
        val payload = chunk.payload
        val nameLength = if (payload.remaining() < Int.SIZE_BYTES) -1 else payload.getInt()
        if (nameLength !in 0..payload.remaining()) throw damaged(chunk.offset, "the name of the jar lies outside its chunk")
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
        DamagedRecordException("$path is damaged at byte $at, ${if (tick == 0L) "before the first tick" else "after tick $tick"}: $what")

    companion object {
        private const val UINT = 0xFFFF_FFFFL

        /**
         * Opens the record at [path].
         *
         * @throws InvalidRecordException when the file is not a record, or has another version.
         * @throws DamagedRecordException when the part before the first step is damaged.
         */
        fun open(path: Path): Record {
            // Opening a pipe would block.
            if (Files.exists(path) &&
                !Files.isRegularFile(path)
            ) {
                throw InvalidRecordException("$path is not a regular file: enter the path of a record")
            }
            val channel = try {
                FileChannel.open(path, READ)
            } catch (_: NoSuchFileException) {
                throw InvalidRecordException(
                    "the record $path does not exist; correct the path, or create a record with the scenario's outputs.record",
                )
            } catch (e: IOException) {
                throw InvalidRecordException("cannot read the record $path: $e")
            }
            return try {
                Record(path, channel)
            } catch (e: IOException) {
                channel.close()
                throw InvalidRecordException("cannot read the record $path: $e")
            } catch (e: RuntimeException) {
                channel.close()
                throw e
            }
        }
    }
}

/** A recorded step: its `StepRequest`, the jars that it loads, and either the answer or the reason for the failure. */
internal class RecordedStep(val request: ByteBuffer, val jars: List<JarBytes>, val answer: StepResponseReader?, val failure: String?)

/** Thrown when a record cannot be used, or only partly; [message] states the reason, the position, and what to do. */
internal sealed class RecordException(message: String) : RuntimeException(message)

/** Thrown when a file is not a record, or the command cannot use it. */
internal class InvalidRecordException(message: String) : RecordException(message)

/** Thrown when a record is damaged after some position. */
internal class DamagedRecordException(message: String) : RecordException(message)
