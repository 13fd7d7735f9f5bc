package org.collektive.engine

import kotlin.random.Random

/**
 * A random stream of Philox4x32-10 (Salmon et al., SC'11). The C# side implements the same stream.
 *
 * The key is [seed]. The counter consists of the index of the block of four words, [node] and [purpose], so streams never overlap. Words
 * are used in order. Not thread-safe.
 *
 * @param purpose the stream's purpose, 0 for [org.collektive.api.Device.random]; `docs/determinism.md` lists them.
 */
public class Philox(private val seed: Long, private val node: Int, private val purpose: Int) : Random() {
    private var nextBlock = 0L
    private val words = IntArray(4)
    private var used = 4

    /** Returns the next 32 random bits. */
    override fun nextInt(): Int {
        if (used == 4) {
            words[0] = nextBlock.toInt()
            words[1] = (nextBlock ushr 32).toInt()
            words[2] = node
            words[3] = purpose
            block(words, seed.toInt(), (seed ushr 32).toInt())
            nextBlock++
            used = 0
        }
        return words[used++]
    }

    override fun nextBits(bitCount: Int): Int = if (bitCount == 0) 0 else nextInt() ushr (32 - bitCount)

    /** Returns the next two words; the first is the high half. */
    override fun nextLong(): Long = nextInt().toLong() shl 32 or (nextInt().toLong() and WORD)

    /** Returns a uniform number in [0, 1) from the upper 53 bits of [nextLong]. */
    override fun nextDouble(): Double = (nextLong() ushr 11) * TWO_TO_MINUS_53

    public companion object {
        private const val WORD = 0xFFFF_FFFFL
        private const val TWO_TO_MINUS_53 = 1.0 / (1L shl 53)
        private const val ROUNDS = 10
        private const val MULTIPLIER_0 = 0xD2511F53L
        private const val MULTIPLIER_1 = 0xCD9E8D57L
        private const val WEYL_0 = -0x61c88647
        private const val WEYL_1 = -0x4498517b

        /** Replaces the four words of [counter] with random ones. */
        public fun block(counter: IntArray, key0: Int, key1: Int) {
            var c0 = counter[0]
            var c1 = counter[1]
            var c2 = counter[2]
            var c3 = counter[3]
            var k0 = key0
            var k1 = key1
            repeat(ROUNDS) {
                val product0 = MULTIPLIER_0 * (c0.toLong() and WORD)
                val product1 = MULTIPLIER_1 * (c2.toLong() and WORD)
                c0 = (product1 ushr 32).toInt() xor c1 xor k0
                c1 = product1.toInt()
                c2 = (product0 ushr 32).toInt() xor c3 xor k1
                c3 = product0.toInt()
                k0 += WEYL_0
                k1 += WEYL_1
            }
            counter[0] = c0
            counter[1] = c1
            counter[2] = c2
            counter[3] = c3
        }
    }
}
