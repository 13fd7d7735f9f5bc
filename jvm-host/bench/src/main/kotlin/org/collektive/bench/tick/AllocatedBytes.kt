package org.collektive.bench.tick

import com.sun.management.ThreadMXBean
import gradientascent.ActuatorData
import gradientascent.SensorData
import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.api.Program
import java.lang.management.ManagementFactory

/** Prints the bytes that this JVM has allocated. The benchmark's C# side reads them from the log. */
@Program("allocated-bytes")
public fun Aggregate<Int>.printAllocatedBytes(@Suppress("UNUSED_PARAMETER") sensors: SensorData): ActuatorData {
    println("allocated-bytes ${allocatedBytes()}")
    return ActuatorData()
}

private val threads = ManagementFactory.getThreadMXBean() as ThreadMXBean

/** Bytes that all live threads have allocated. */
internal fun allocatedBytes(): Long = threads.getThreadAllocatedBytes(threads.allThreadIds).sumOf { maxOf(it, 0) }
