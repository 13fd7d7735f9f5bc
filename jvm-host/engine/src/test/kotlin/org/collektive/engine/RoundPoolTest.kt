package org.collektive.engine

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import java.util.concurrent.CountDownLatch
import java.util.concurrent.atomic.AtomicBoolean
import java.util.concurrent.atomic.AtomicIntegerArray
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class RoundPoolTest {
    private val distantDeadline get() = System.nanoTime() + 60_000_000_000

    @Test
    fun `every index is processed once, for any count, range and number of threads`() {
        val random = Random(1)
        for (threads in listOf(1, 2, 3, 8)) {
            val pool = RoundPool(threads)
            repeat(200) {
                val count = random.nextInt(1, 500)
                val range = random.nextInt(1, 60)
                val done = AtomicIntegerArray(count)
                val task = RoundPool.Task<AtomicIntegerArray> { counts, _, _, begin, end ->
                    for (index in begin until end) counts.incrementAndGet(index)
                }
                assertTrue(pool.run(task, done, count, range, distantDeadline))
                for (index in 0 until count) assertEquals(1, done[index], "index $index of $count in ranges of $range on $threads threads")
            }
            pool.abandon()
        }
    }

    @Test
    @Timeout(60)
    fun `a limit does not expire while its clock is stopped, and expires once the clock runs again`() {
        val debugged = AtomicBoolean(true)
        val pool = RoundPool(1, { if (debugged.get()) 0L else System.nanoTime() })
        val task = RoundPool.Task<Long> { millis, _, _, _, _ -> Thread.sleep(millis) }
        assertTrue(pool.run(task, 300L, 1, 1, 1_000_000))
        debugged.set(false)
        assertFalse(pool.run(task, 300L, 1, 1, System.nanoTime() + 1_000_000))
        pool.abandon()
    }

    @Test
    @Timeout(60)
    fun `threads end when a later one cannot start`() {
        val started = ArrayList<Thread>()
        assertFailsWith<OutOfMemoryError> {
            RoundPool(3) { thread ->
                if (started.size == 2) throw OutOfMemoryError("unable to create native thread")
                thread.start()
                started += thread
            }
        }
        assertEquals(2, started.size)
        started.forEach(Thread::join)
    }

    @Test
    @Timeout(60)
    fun `an idle thread takes over work of the others`() {
        val pool = RoundPool(2)
        val workers = AtomicIntegerArray(100)
        val othersAreDone = CountDownLatch(99)
        val task = RoundPool.Task<AtomicIntegerArray> { doneBy, _, worker, begin, _ ->
            if (begin == 0) othersAreDone.await() else othersAreDone.countDown()
            doneBy[begin] = worker
        }
        assertTrue(pool.run(task, workers, 100, 1, distantDeadline))
        pool.abandon()
        val free = 1 - workers[0]
        assertTrue((1 until 50).all { workers[it] == free }, "the free thread must take over the share of the thread that waits")
    }
}
