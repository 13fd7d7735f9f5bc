package org.collektive.engine

import org.junit.jupiter.api.Test
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.security.MessageDigest
import kotlin.random.Random
import kotlin.test.assertEquals

class RoundDigestTest {
    @Test
    fun `the chain is the documented one`() {
        val random = Random(1)
        val buffer = ByteBuffer.allocateDirect(100_000).order(ByteOrder.LITTLE_ENDIAN)
        for (at in 0 until buffer.capacity()) buffer.put(at, random.nextInt().toByte())
        val digest = RoundDigest()
        var chain = ByteArray(32)
        for (tick in 1L..20L) {
            val sha = MessageDigest.getInstance("SHA-256")
            sha.update(chain)
            sha.update(little(8).putLong(0, tick).array())
            digest.begin(tick)
            for (node in 0 until random.nextInt(2000)) {
                val length = if (node % 5 == 0) {
                    -1
                } else if (node == 7) {
                    20_000
                } else {
                    random.nextInt(40)
                }
                sha.update(little(8).putInt(0, node).putInt(4, length).array())
                if (length < 0) {
                    digest.failure(node)
                } else {
                    val offset = random.nextInt(buffer.capacity() - length)
                    digest.answer(node, buffer, offset, length)
                    for (at in offset until offset + length) sha.update(buffer.get(at))
                }
            }
            digest.end()
            chain = sha.digest()
            assertEquals(ByteBuffer.wrap(chain).order(ByteOrder.LITTLE_ENDIAN).getLong(), digest.value)
        }
    }

    @Test
    fun `adding several answers at once equals adding them one by one`() {
        val random = Random(2)
        val length = 12
        val entryBytes = RoundDigest.HEADER_BYTES + length
        val entries = little(1000 * entryBytes)
        val oneByOne = RoundDigest()
        val blocks = RoundDigest()
        for (tick in 1L..20L) {
            random.nextBytes(entries.array())
            for (node in 0 until 1000) RoundDigest.putHeader(entries, node * entryBytes, node, length)
            oneByOne.begin(tick)
            blocks.begin(tick)
            var begin = 0
            for (node in 0 until 1000) {
                if (random.nextInt(100) > 0) {
                    oneByOne.answer(node, entries, node * entryBytes + RoundDigest.HEADER_BYTES, length)
                } else {
                    oneByOne.failure(node)
                    blocks.answers(entries.array(), begin * entryBytes, node * entryBytes)
                    blocks.failure(node)
                    begin = node + 1
                }
            }
            blocks.answers(entries.array(), begin * entryBytes, 1000 * entryBytes)
            oneByOne.end()
            blocks.end()
            assertEquals(oneByOne.value, blocks.value)
        }
    }

    private fun little(bytes: Int) = ByteBuffer.allocate(bytes).order(ByteOrder.LITTLE_ENDIAN)
}
