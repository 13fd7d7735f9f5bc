package org.collektive.host.shim

import java.util.Properties
import java.util.function.LongSupplier

/** A clock like `System.nanoTime()` that stops while a debugger is attached to this JVM, so time limits exclude breakpoints. */
internal object Debugger : LongSupplier {
    // The debugger agent sets this property to its address while it listens, and clears it when a debugger attaches.
    private const val LISTENER = "sun.jdwp.listenerAddress"
    private const val POLL_MILLIS = 20L

    @Volatile
    private var excluded = 0L

    // The time at which the current debugger attached; 0 without one.
    @Volatile
    private var attached = 0L

    override fun getAsLong(): Long {
        val since = attached
        return (if (since == 0L) System.nanoTime() else since) - excluded
    }

    /** Reports to [shim] whenever a debugger attaches or detaches, if this JVM listens for debuggers. */
    fun watch(shim: ShimCalls) {
        val properties = agentProperties()?.takeIf { it.getProperty(LISTENER) != null } ?: return
        val watch = Thread({
            while (true) {
                update(properties.getProperty(LISTENER).isEmpty(), shim)
                Thread.sleep(POLL_MILLIS)
            }
        }, "collektive-debugger")
        watch.isDaemon = true
        watch.start()
    }

    private fun update(isAttached: Boolean, shim: ShimCalls) {
        if (isAttached == (attached != 0L)) return
        if (isAttached) {
            attached = System.nanoTime()
        } else {
            // In this order, a concurrent reader may see an earlier time, but never a later one.
            excluded += System.nanoTime() - attached
            attached = 0
        }
        shim.debugger(isAttached)
    }

    /** The properties of agents; null in a JVM that was started without the option that exports them. */
    private fun agentProperties(): Properties? = try {
        Class.forName("jdk.internal.vm.VMSupport").getMethod("getAgentProperties").invoke(null) as? Properties
    } catch (_: ReflectiveOperationException) {
        null
    }
}
