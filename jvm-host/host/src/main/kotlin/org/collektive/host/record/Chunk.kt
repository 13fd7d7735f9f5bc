package org.collektive.host.record

import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.util.zip.CRC32

/**
 * One chunk of a record; see `docs/record-format.md`.
 *
 * @property kind one of the kinds in the companion object.
 * @property offset start of the chunk in the file, in bytes.
 * @property payload the content, from position to limit.
 */
public class Chunk(public val kind: Int, public val offset: Long, public val payload: ByteBuffer) {
    /** The [kind] as text. */
    public val name: String get() = name(kind)

    /** The kinds of chunks, and their common header. */
    public companion object {
        /** Size of the header in bytes: kind, length of the payload, CRC-32 of both and of the payload. */
        public const val HEADER_BYTES: Int = 12

        /** Offset of the CRC-32 in the header, in bytes. */
        public const val CHECKSUM_AT: Int = 8

        public val HEAD: Int = kind("HEAD")
        public val OPEN: Int = kind("OPEN")
        public val JAR: Int = kind("JAR ")
        public val STEP: Int = kind("STEP")
        public val DONE: Int = kind("DONE")
        public val FAIL: Int = kind("FAIL")
        public val END: Int = kind("END ")

        /** Returns [kind] as text. */
        public fun name(kind: Int): String = String(bytes(kind), Charsets.ISO_8859_1).trim().filter { it in ' '..'~' }

        /** Returns the CRC-32 of the bytes of [header] before the checksum and of [payload]. Does not change their positions. */
        public fun checksum(crc: CRC32, header: ByteBuffer, payload: ByteBuffer): Int {
            crc.reset()
            for (index in 0 until CHECKSUM_AT) crc.update(header.get(index).toInt())
            val begin = payload.position()
            crc.update(payload)
            payload.position(begin)
            return crc.value.toInt()
        }

        private fun kind(name: String) = ByteBuffer.wrap(name.encodeToByteArray()).order(ByteOrder.LITTLE_ENDIAN).getInt()

        private fun bytes(kind: Int) = ByteArray(Int.SIZE_BYTES) { (kind ushr 8 * it).toByte() }
    }
}
