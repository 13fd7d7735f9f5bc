package org.collektive.host.record

import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.util.zip.CRC32

/** One piece of a record: what it holds, where in the file it begins, its bytes. docs/record-format.md is the format. */
internal class Chunk(val kind: Int, val offset: Long, val payload: ByteBuffer) {
    val name: String get() = name(kind)

    /** Kinds of chunks, and what all of them begin with: kind, length of the payload, CRC-32 of both and of the payload. */
    companion object {
        const val HEADER_BYTES = 12
        const val CHECKSUM_AT = 8

        val HEAD = kind("HEAD")
        val OPEN = kind("OPEN")
        val JAR = kind("JAR ")
        val STEP = kind("STEP")
        val DONE = kind("DONE")
        val FAIL = kind("FAIL")
        val END = kind("END ")

        fun name(kind: Int): String = String(bytes(kind), Charsets.ISO_8859_1).trim().filter { it in ' '..'~' }

        /** Of what lies in [header] before the checksum, and of [payload]; moves neither. */
        fun checksum(crc: CRC32, header: ByteBuffer, payload: ByteBuffer): Int {
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
