package org.collektive.bench.tick

import org.collektive.host.Host
import org.collektive.host.shim.LogLevel
import org.collektive.host.shim.ShimCalls
import java.net.InetAddress
import java.net.InetSocketAddress
import java.net.StandardSocketOptions
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.nio.channels.ServerSocketChannel
import java.nio.channels.SocketChannel

/** A benchmark of ticks that runs only on this JVM. */
internal interface Workload : AutoCloseable {
    fun tick()
}

/**
 * The benchmark's second process: serves the host over TCP on loopback, and runs workloads without C#.
 *
 * Prints its port, serves one client, and exits when it disconnects. A request is kind, id, length (i32 each) and payload; an answer is
 * status (i32, 0 for success), length (i32) and payload. All numbers are little-endian.
 */
public fun main() {
    ServerSocketChannel.open().use { listener ->
        listener.bind(InetSocketAddress(InetAddress.getLoopbackAddress(), 0))
        println((listener.localAddress as InetSocketAddress).port)
        listener.accept().use { Server(it).serve() }
    }
}

private class Server(private val client: SocketChannel) : ShimCalls {
    private var request = buffer(1 shl 16)
    private var answer = buffer(1 shl 16)
    private val workloads = HashMap<Int, Workload>()

    init {
        client.setOption(StandardSocketOptions.TCP_NODELAY, true)
        Host.shim = this
    }

    fun serve() {
        while (read(REQUEST_HEADER)) {
            val kind = request.getInt(0)
            val id = request.getInt(Int.SIZE_BYTES)
            val length = request.getInt(2 * Int.SIZE_BYTES)
            if (!read(REQUEST_HEADER + length)) return
            val reply = when (kind) {
                OPEN -> framed(Host.open(id.toLong(), request, REQUEST_HEADER, length, 0, answer, LIMIT_MILLIS))

                STEP -> framed(Host.step(id.toLong(), request, REQUEST_HEADER, length, 0, answer, LIMIT_MILLIS))

                CLOSE -> numbers().also {
                    Host.close(id.toLong())
                    workloads.remove(id)?.close()
                }

                ENGINE -> numbers().also { workloads[id] = EngineOnly(Grid(number(0)), number(1)) }

                LOOPS -> numbers().also { workloads[id] = Loops(Grid(number(0))) }

                RUN -> run(checkNotNull(workloads[id]) { "unknown workload $id" }, number(0))

                REPORT -> numbers(allocatedBytes())

                else -> throw IllegalArgumentException("unknown request kind $kind")
            }
            while (reply.hasRemaining()) client.write(reply)
            request.clear()
        }
    }

    private fun number(index: Int): Int = request.getInt(REQUEST_HEADER + index * Int.SIZE_BYTES)

    /** Reads until the request has [bytes] bytes; returns `false` when the client has disconnected. */
    private fun read(bytes: Int): Boolean {
        if (request.capacity() < bytes) request = buffer(2 * bytes).put(request.flip())
        while (request.position() < bytes) if (client.read(request) < 0) return false
        return true
    }

    /** The host's answer with a header before it; copies the answer only if the header does not fit before it. */
    private fun framed(written: Long): ByteBuffer {
        if (written < 0) return numbers(status = written.toInt())
        val offset = (written ushr Int.SIZE_BITS).toInt()
        val length = written.toInt()
        if (offset < ANSWER_HEADER) {
            val moved = buffer(ANSWER_HEADER + length)
            moved.putInt(0).putInt(length).put(answer.clear().position(offset).limit(offset + length))
            return moved.flip()
        }
        answer.clear()
        answer.putInt(offset - ANSWER_HEADER, 0).putInt(offset - Int.SIZE_BYTES, length)
        return answer.position(offset - ANSWER_HEADER).limit(offset + length)
    }

    private fun run(workload: Workload, ticks: Int): ByteBuffer {
        val nanos = LongArray(ticks) {
            val begin = System.nanoTime()
            workload.tick()
            System.nanoTime() - begin
        }
        return numbers(*nanos)
    }

    private fun numbers(vararg values: Long, status: Int = 0): ByteBuffer {
        val reply = buffer(ANSWER_HEADER + Long.SIZE_BYTES * values.size).putInt(status).putInt(Long.SIZE_BYTES * values.size)
        values.forEach(reply::putLong)
        return reply.flip()
    }

    override fun grow(slot: Long, capacity: Int): ByteBuffer = buffer(capacity).also { answer = it }

    override fun error(text: String): Unit = System.err.println(text)

    override fun log(level: LogLevel, line: String): Unit = System.err.println(line)

    private companion object {
        const val REQUEST_HEADER = 12
        const val ANSWER_HEADER = 8
        const val LIMIT_MILLIS = 60_000
        const val OPEN = 1
        const val STEP = 2
        const val CLOSE = 3
        const val ENGINE = 4
        const val LOOPS = 5
        const val RUN = 6
        const val REPORT = 7

        fun buffer(bytes: Int): ByteBuffer = ByteBuffer.allocateDirect(bytes).order(ByteOrder.LITTLE_ENDIAN)
    }
}
