package org.collektive.bench.tick

import com.sun.management.ThreadMXBean
import gradientascent.ActuatorDataT
import gradientascent.SensorData
import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.api.Program
import org.collektive.schema.Vector3T
import java.lang.management.ManagementFactory

/** Prints the bytes that this JVM has allocated. The benchmark's C# side reads them from the log. */
@Program("allocated-bytes")
public fun Aggregate<Int>.printAllocatedBytes(@Suppress("UNUSED_PARAMETER") sensors: SensorData): ActuatorDataT {
    println("allocated-bytes ${allocatedBytes()}")
    return ActuatorDataT().apply { target = Vector3T() }
}

private val threads = ManagementFactory.getThreadMXBean() as ThreadMXBean

/** Bytes that all live threads have allocated. */
internal fun allocatedBytes(): Long = threads.getThreadAllocatedBytes(threads.allThreadIds).sumOf { maxOf(it, 0) }
