package org.collektive.host.shim

import java.nio.ByteBuffer

/** What the shim offers the host; the shim registers these natives before it calls the host. */
public object Shim {
    /** A larger buffer for the answer [slot], or `null` without memory. The old one stays readable until the call returns. */
    @JvmStatic
    public external fun grow(slot: Long, capacity: Int): ByteBuffer?

    /** Text of the error code about to be returned. */
    @JvmStatic
    public external fun error(utf8: ByteArray)

    /** One log line, from any thread; never blocks. */
    @JvmStatic
    public external fun log(level: Int, utf8: ByteArray)
}

/** [Shim] as the host uses it, so that the host also runs without the native library. */
public interface ShimCalls {
    /** See [Shim.grow]. */
    public fun grow(slot: Long, capacity: Int): ByteBuffer?

    /** See [Shim.error]. */
    public fun error(text: String)

    /** See [Shim.log]. */
    public fun log(level: LogLevel, line: String)
}

internal object NativeShim : ShimCalls {
    override fun grow(slot: Long, capacity: Int): ByteBuffer? = Shim.grow(slot, capacity)

    override fun error(text: String) = Shim.error(text.encodeToByteArray())

    override fun log(level: LogLevel, line: String) = Shim.log(level.ordinal, line.encodeToByteArray())
}

/** `clk_log_level`. */
public enum class LogLevel { DEBUG, INFO, WARNING, ERROR }
