package faults

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.neighboring
import jdk.jfr.Event
import org.collektive.api.Device
import org.collektive.api.Parameter
import org.collektive.api.Program
import probe.ActuatorData
import probe.SensorData
import java.lang.Thread.sleep
import java.nio.ByteBuffer
import java.util.concurrent.CountDownLatch
import java.util.concurrent.Executors
import java.util.logging.LogManager
import kotlin.concurrent.thread

/** Counts its rounds, and causes the parameter's fault in a round whose sensor is 1. */
@Program("fault", parameters = [Parameter("fault", "none", "The fault that occurs when the value is 1.")])
public fun Aggregate<Int>.fault(sensors: SensorData, device: Device): ActuatorData {
    val rounds = evolve(0) { it + 1 }
    if (sensors.value() == 1f) misbehave(device.parameters["fault"], sensors)
    return ActuatorData(rounds.toFloat())
}

private val retainedObjects = ArrayList<Any>()

private fun Aggregate<Int>.misbehave(fault: String, sensors: SensorData) {
    when (fault) {
        "none" -> {}

        "throw" -> error("thirteen")

        "throw-without-words" -> throw ExceptionWithoutMessage()

        "record-much" -> repeat(300_000) { BulkEvent(it).commit() }

        "assert" -> throw AssertionError("never true")

        "no-class" -> throw NoClassDefFoundError("nowhere/Missing")

        "loop" -> while (true) Thread.onSpinWait()

        "wait" -> CountDownLatch(1).let {
            while (true) {
                try {
                    it.await()
                } catch (_: InterruptedException) {}
            }
        }

        "sleep" -> sleep(Long.MAX_VALUE)

        "interrupt" -> Thread.currentThread().interrupt()

        "recurse" -> recurse(0)

        "recurse-aligned" -> recurseAligned()

        "heap" -> generateSequence { LongArray(1 shl 20) }.toList()

        "heap-kept" -> fillHeap()

        "array" -> LongArray(Int.MAX_VALUE)

        "direct" -> generateSequence { ByteBuffer.allocateDirect(1 shl 22) }.toList()

        "metaspace" -> generateSequence { Copies().make() }.toList()

        "exit" -> System.exit(3)

        "halt" -> Runtime.getRuntime().halt(3)

        "exit-later" -> thread { System.exit(3) }.join()

        "exit-hook" -> Runtime.getRuntime().addShutdownHook(Thread { while (true) Thread.onSpinWait() })

        "threads" -> repeat(300) { startNonDaemonThread { sleep(Long.MAX_VALUE) } }

        "thread-pool" -> Executors.newFixedThreadPool(4).also { pool -> repeat(4) { pool.submit {} } }

        "busy-thread" -> startNonDaemonThread { while (true) Thread.onSpinWait() }

        "thread-throws" -> thread { error("in a thread") }.join()

        "print" -> while (true) println("printing endlessly")

        "print-much" -> repeat(200_000) { println("line $it") }

        "print-one-line" -> repeat(20_000) { print("x".repeat(1000)) }

        "take-output" -> {
            System.setOut(null)
            System.setErr(null)
            LogManager.getLogManager().reset()
        }

        "share-view" -> neighboring(sensors)

        "keep-view" -> evolve<Any>(0) { old -> if (old == 1) old else sensors }

        else -> error("unknown fault '$fault'")
    }
}

/** Starts a thread that the JVM waits for when it ends. */
private fun startNonDaemonThread(work: () -> Unit) {
    Thread(work).apply { isDaemon = false }.start()
}

private class BulkEvent(@JvmField val number: Int) : Event()

private class ExceptionWithoutMessage : RuntimeException() {
    override val message: String get() = error("no words")
    override fun toString(): String = error("no words")
}

private fun recurse(depth: Int): Int = recurse(depth + 1) + 1

private fun Aggregate<Int>.recurseAligned(): Int = evolve(0) { it } + recurseAligned()

/** Fills the whole heap for the lifetime of the class. */
private fun fillHeap(): Nothing {
    var size = 1 shl 22
    while (true) {
        try {
            retainedObjects.add(ByteArray(size))
        } catch (full: OutOfMemoryError) {
            if (size == 16) throw full
            size /= 2
        }
    }
}

/** A loader that defines another class from the bytes of this one. */
private class Copies : ClassLoader(null) {
    fun make(): Class<*> = defineClass(NAME, BYTES, 0, BYTES.size)

    private companion object {
        const val NAME = "faults.Filler"
        val BYTES: ByteArray = Copies::class.java.getResourceAsStream("/faults/Filler.class")!!.readAllBytes()
    }
}

internal open class Filler {
    @JvmField
    val text: String = "filler"
}
