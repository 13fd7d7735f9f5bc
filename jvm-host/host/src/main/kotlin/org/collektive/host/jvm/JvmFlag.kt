package org.collektive.host.jvm

import com.sun.management.HotSpotDiagnosticMXBean
import java.lang.management.ManagementFactory

private val diagnostics by lazy { ManagementFactory.getPlatformMXBean(HotSpotDiagnosticMXBean::class.java) }

/** Returns the value of the JVM's flag [name], or `null` if this JVM does not have the flag. */
internal fun jvmFlag(name: String): String? = try {
    diagnostics.getVMOption(name).value
} catch (_: IllegalArgumentException) {
    null
}
