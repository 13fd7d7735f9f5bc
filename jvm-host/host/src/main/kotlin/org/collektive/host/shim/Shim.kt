package org.collektive.host.shim

import java.nio.ByteBuffer

/** The native functions of the shim, which registers them before it calls the host. */
public object Shim {
    /**
     * Grows the buffer of [slot] to at least [capacity] bytes and returns the new buffer, which the shim owns. The old buffer stays readable
     * until the host call returns. Call it on the engine thread.
     *
     * @throws OutOfMemoryError when memory is exhausted; other implementations of [ShimCalls] may return `null`.
     * @throws IllegalStateException when [slot] is not the answer slot of the running call.
     */
    @JvmStatic
    public external fun grow(slot: Long, capacity: Int): ByteBuffer?

    /** Sets the message of the error code that the host call is about to return. */
    @JvmStatic
    public external fun error(utf8: ByteArray)

    /** Logs one line. [level] is a value of `clk_log_level`. Thread-safe and non-blocking. */
    @JvmStatic
    public external fun log(level: Int, utf8: ByteArray)

    /** Reports that a debugger has attached or detached: then the caller must not wait for the host. Thread-safe and non-blocking. */
    @JvmStatic
    public external fun debugger(attached: Boolean)
}

/** The functions of [Shim] as an interface, so that the host also runs without the native library. */
public interface ShimCalls {
    /** See [Shim.grow]. */
    public fun grow(slot: Long, capacity: Int): ByteBuffer?

    /** See [Shim.error]. */
    public fun error(text: String)

    /** See [Shim.log]. */
    public fun log(level: LogLevel, line: String)

    /** See [Shim.debugger]. */
    public fun debugger(attached: Boolean) {}
}

internal object NativeShim : ShimCalls {
    override fun grow(slot: Long, capacity: Int): ByteBuffer? = Shim.grow(slot, capacity)

    override fun error(text: String) = Shim.error(text.encodeToByteArray())

    override fun log(level: LogLevel, line: String) = Shim.log(level.ordinal, line.encodeToByteArray())

    override fun debugger(attached: Boolean) = Shim.debugger(attached)
}

/** The values of `clk_log_level`. */
public enum class LogLevel { DEBUG, INFO, WARNING, ERROR }
