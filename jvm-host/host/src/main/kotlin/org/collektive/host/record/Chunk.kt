package org.collektive.host.record

import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.util.zip.CRC32

/** One piece of a record: what it holds, where in the file it begins, its bytes. docs/record-format.md is the format. */
public class Chunk(public val kind: Int, public val offset: Long, public val payload: ByteBuffer) {
    /** Its kind as text. */
    public val name: String get() = name(kind)

    /** Kinds of chunks, and what all of them begin with: kind, length of the payload, CRC-32 of both and of the payload. */
    public companion object {
        public const val HEADER_BYTES: Int = 12
        public const val CHECKSUM_AT: Int = 8

        public val HEAD: Int = kind("HEAD")
        public val OPEN: Int = kind("OPEN")
        public val JAR: Int = kind("JAR ")
        public val STEP: Int = kind("STEP")
        public val DONE: Int = kind("DONE")
        public val FAIL: Int = kind("FAIL")
        public val END: Int = kind("END ")

        /** [kind] as text. */
        public fun name(kind: Int): String = String(bytes(kind), Charsets.ISO_8859_1).trim().filter { it in ' '..'~' }

        /** The CRC-32 of what lies in [header] before the checksum, and of [payload]; moves neither. */
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
