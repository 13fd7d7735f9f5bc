package org.collektive.tools.record

import org.collektive.host.record.Chunk
import org.collektive.host.record.RecordWriter
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.nio.file.Files
import java.nio.file.Path
import java.util.zip.CRC32
import kotlin.io.path.writeBytes

/**
 * Reads arbitrary bytes as a record, to the end or up to a [RecordException].
 *
 * It first corrects the checksums, because those of fuzzed bytes would never match. It does not run the programs of the record.
 */
internal object RecordFuzzer {
    private val file: Path by lazy { Files.createTempFile("fuzzed", ".clkrec").also { it.toFile().deleteOnExit() } }

    /** Tests an input. Jazzer calls this for each one. */
    @JvmStatic
    fun fuzzerTestOneInput(bytes: ByteArray) {
        run(bytes)
    }

    /** Reads the record. Returns the number of steps, or -1 if the record is rejected or damaged. */
    fun run(bytes: ByteArray): Int {
        file.writeBytes(sealed(bytes))
        return try {
            Record.open(file).use { record ->
                var steps = 0
                while (record.next() != null) steps++
                steps
            }
        } catch (_: RecordException) {
            -1
        }
    }

    /** Returns [bytes] with the correct checksum in each complete chunk. */
    fun sealed(bytes: ByteArray): ByteArray {
        val sealed = bytes.copyOf()
        val record = ByteBuffer.wrap(sealed).order(ByteOrder.LITTLE_ENDIAN)
        var at = RecordWriter.MAGIC.size
        while (at + Chunk.HEADER_BYTES <= sealed.size) {
            val length = record.getInt(at + Int.SIZE_BYTES)
            if (length !in 0..sealed.size - at - Chunk.HEADER_BYTES) break
            val crc = CRC32().apply {
                update(sealed, at, Chunk.CHECKSUM_AT)
                update(sealed, at + Chunk.HEADER_BYTES, length)
            }
            record.putInt(at + Chunk.CHECKSUM_AT, crc.value.toInt())
            at += Chunk.HEADER_BYTES + length
        }
        return sealed
    }
}
