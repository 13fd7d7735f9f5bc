package org.collektive.host

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import java.nio.ByteBuffer
import java.nio.ByteOrder
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Tests that damaged frames are either processed or rejected with a code, and that a rejected frame changes nothing. */
@Timeout(120)
class FrameFuzzTest {
    private val shim = TestShim()

    @Test
    fun `damaged frames are refused without effect, or accepted by all sessions`() {
        val random = Random(11)
        val fuzzed = TestSession(shim).apply { open(program = "sum") }
        val control = TestSession(shim).apply { open(program = "sum") }
        var tick = 1L
        fun both(bytes: ByteBuffer) {
            val code = fuzzed.step(bytes)
            val text = shim.error
            val expected = control.step(bytes)
            assertEquals(code < 0, expected < 0, text)
            if (code >= 0) tick++
        }
        both(
            Step(1).apply {
                added = (0 until 10).map { Step.Added(it) }
                due = (0 until 10).toList()
            }.bytes(),
        )
        var refused = 0
        repeat(6000) { round ->
            val damaged = damage(valid(tick, random, round), random)
            val code = fuzzed.step(damaged)
            if (code < 0) {
                assertTrue(code == -12L || code == -14L, "$code: ${shim.error}")
                refused++
            } else {
                assertTrue(control.step(damaged) >= 0, shim.error)
                tick++
            }
            if (round % 20 == 0) {
                val next = Step(tick++)
                assertEquals(state(control, next), state(fuzzed, next))
            }
        }
        assertTrue(refused > 2000, "more than 2000 frames must be rejected, but only $refused were")
        fuzzed.close()
        control.close()
    }

    @Test
    fun `random and truncated frames are refused`() {
        val random = Random(5)
        val session = TestSession(shim).apply { open() }
        repeat(2000) {
            val bytes = direct(random.nextBytes(random.nextInt(1, 400)))
            assertTrue(session.step(bytes) in listOf(-12L, -14L), shim.error)
        }
        val whole = valid(1, random, 1)
        for (length in 0 until whole.capacity()) {
            val cut = ByteArray(length).also { whole.get(0, it) }
            val code = session.step(direct(cut))
            assertTrue(code == -12L, "code $code for a frame cut to $length of ${whole.capacity()} bytes")
        }
        session.close()
    }

    @Test
    fun `a frame outside of its slot is refused`() {
        val session = TestSession(shim).apply { open() }
        val frame = Step(1).bytes()
        for ((offset, length) in listOf(-1 to 8, 0 to frame.capacity() + 1, 4 to frame.capacity(), 0 to 0, Int.MAX_VALUE to 8, 0 to -5)) {
            assertEquals(-12L, session.step(frame, offset = offset, length = length), shim.error)
            assertContains(shim.error, "lie outside the slot of ${frame.capacity()} bytes")
            assertEquals(-12L, Host.open(1_000_000, frame, offset, length, 1, ByteBuffer.allocateDirect(64), 1000))
        }
        assertTrue(session.step(frame) >= 0, shim.error)
        session.close()
    }

    @Test
    fun `random open requests are refused`() {
        Host.shim = shim
        val random = Random(8)
        repeat(500) {
            val bytes = direct(random.nextBytes(random.nextInt(1, 200)))
            val code = Host.open(1_000_001, bytes, 0, bytes.capacity(), 1, ByteBuffer.allocateDirect(64), 1000)
            assertEquals(-12L, code, shim.error)
        }
    }

    private fun state(session: TestSession, step: Step): List<Any> {
        val answer = session.ok(step.apply { sensors = emptyList() })
        return listOf(answer.digest(), answer.nodeCount(), answer.linkCount())
    }

    /** Returns a frame that is often valid. It adds and removes random nodes and links, whether or not they exist. */
    private fun valid(tick: Long, random: Random, round: Int): ByteBuffer = Step(tick).apply {
        added = List(random.nextInt(3)) { Step.Added(1000 + round * 3 + it, listOf(null, "sum").random(random)) }
        linked = List(random.nextInt(5)) { random.nextInt(5) to random.nextInt(5, 10) }.distinct()
        due = (0 until 10).filter { random.nextBoolean() }
        sensors = due.map { Step.Sensor(it, if (random.nextBoolean()) "label" else null, random.nextInt(4)) }
        if (random.nextInt(4) == 0) wind = random.nextFloat()
    }.bytes()

    private fun damage(frame: ByteBuffer, random: Random): ByteBuffer {
        var bytes = ByteArray(frame.capacity()).also { frame.get(0, it) }
        repeat(random.nextInt(0, 4)) {
            val at = random.nextInt(bytes.size)
            when (random.nextInt(5)) {
                0 -> bytes[at] = random.nextInt().toByte()

                1 -> bytes[at] = (bytes[at].toInt() xor (1 shl random.nextInt(8))).toByte()

                2 -> bytes = bytes.copyOf(maxOf(1, at))

                3 -> if (at + 4 <=
                    bytes.size
                ) {
                    ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN).putInt(at and 3.inv(), random.nextInt())
                }

                else -> if (at + 4 <= bytes.size) {
                    ByteBuffer.wrap(
                        bytes,
                    ).order(ByteOrder.LITTLE_ENDIAN).putInt(at and 3.inv(), listOf(0, -1, Int.MAX_VALUE, Int.MIN_VALUE, 4).random(random))
                }
            }
        }
        return direct(bytes)
    }
}
