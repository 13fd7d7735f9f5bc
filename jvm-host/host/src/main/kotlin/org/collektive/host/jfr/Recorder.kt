package org.collektive.host.jfr

import jdk.jfr.Configuration
import jdk.jfr.Recording
import org.collektive.host.shim.LogLevel
import org.collektive.host.shim.ShimCalls
import java.io.IOException
import java.nio.file.Files
import java.nio.file.NoSuchFileException
import java.nio.file.Path
import java.nio.file.StandardCopyOption.REPLACE_EXISTING
import java.text.ParseException
import java.util.concurrent.ExecutorService
import java.util.concurrent.Executors
import java.util.concurrent.TimeUnit

/**
 * Controls the flight recording of this JVM, at most one at a time.
 *
 * Actions are slow (the first start takes hundreds of milliseconds), so they run sequentially on a separate thread. [state], [error] and
 * the log report their outcome later. Call the functions from one thread.
 */
internal class Recorder(private val shim: ShimCalls) {
    enum class State { OFF, STARTING, ON, DUMPING, STOPPING }

    private var worker: ExecutorService? = null
    private var recording: Recording? = null

    /** Number of actions that have not ended; guarded by this. */
    private var pendingActions = 0

    /** The last requested action while actions are pending; otherwise [State.ON] or [State.OFF]. */
    @Volatile
    var state = State.OFF
        private set

    /** File of the current or last recording; `null` before the first. */
    @Volatile
    var path: String? = null
        private set

    /** Error message of the last action; `null` when it succeeded. */
    @Volatile
    var error: String? = null
        private set

    /** Duration of the last action in milliseconds. */
    @Volatile
    var millis = 0
        private set

    /** Number of recordings and dumps written. */
    @Volatile
    var written = 0
        private set

    /** Starts a recording; [stop] writes it to [file]. [settings] are "default", "profile" or the path of a `.jfc` file. */
    fun start(settings: String, file: String) = submit(State.STARTING) {
        check(recording == null) { "a recording to $path is already running; stop it first" }
        val target = target(file)
        SessionEvents.prepare()
        val started = Recording(configuration(settings))
        try {
            started.name = "collektive"
            started.maxSize = MAX_BYTES
            started.start()
        } catch (e: Throwable) {
            started.close()
            throw e
        }
        path = target.toString()
        recording = started
    }

    /** Writes the data recorded so far to [file]; the recording continues. */
    fun dump(file: String) = submit(State.DUMPING) { write(running(), target(file)) }

    /** Stops the recording and writes its file. */
    fun stop() = submit(State.STOPPING) { finish(running()) }

    /** Stops a running recording, and waits at most [limitMillis] milliseconds until its file is written. */
    fun close(limitMillis: Int) {
        val worker = worker ?: return
        if (state != State.OFF) submit(State.STOPPING) { recording?.let(::finish) }
        worker.shutdown()
        if (!worker.awaitTermination(limitMillis.toLong(), TimeUnit.MILLISECONDS)) {
            shim.log(LogLevel.ERROR, "the flight recording $path was not written within $limitMillis ms and may be missing")
        }
        this.worker = null
    }

    private fun submit(busy: State, action: () -> Unit) {
        synchronized(this) {
            pendingActions++
            state = busy
        }
        val worker =
            worker ?: Executors.newSingleThreadExecutor { Thread(it, "collektive-jfr").apply { isDaemon = true } }.also { worker = it }
        worker.execute {
            val begin = System.nanoTime()
            error = null
            try {
                action()
            } catch (e: Throwable) {
                val text = "flight recording: ${text(e)}"
                error = text
                shim.log(LogLevel.ERROR, text)
            }
            millis = TimeUnit.NANOSECONDS.toMillis(System.nanoTime() - begin).toInt()
            synchronized(this) {
                // Another action may have been requested in the meantime.
                if (--pendingActions == 0) state = if (recording == null) State.OFF else State.ON
            }
        }
    }

    private fun text(failure: Throwable): String = when (failure) {
        is NoSuchFileException -> "the file or folder does not exist: ${failure.file}; correct its path"
        is IOException -> "cannot write the file: ${failure.message ?: failure}; free disk space or choose another file"
        is IllegalStateException, is IllegalArgumentException -> failure.message ?: failure.toString()
        else -> failure.toString()
    }

    private fun running() = checkNotNull(recording) { "no recording is running; start one first" }

    private fun target(file: String): Path {
        require(file.isNotBlank()) { "the file name is empty; enter the file to write" }
        val target = Path.of(file).toAbsolutePath()
        require(!Files.isDirectory(target)) { "$target is a folder; name a file in it" }
        Files.createDirectories(target.parent)
        return target
    }

    private fun configuration(settings: String): Configuration {
        Configuration.getConfigurations().find { it.name == settings }?.let { return it }
        require(settings.endsWith(".jfc")) {
            val known = Configuration.getConfigurations().map { it.name }.sorted().joinToString()
            "unknown settings '$settings'; use $known or the path of a .jfc file"
        }
        return try {
            Configuration.create(Path.of(settings))
        } catch (e: ParseException) {
            throw IllegalArgumentException("$settings is not a valid .jfc file: ${e.message}", e)
        }
    }

    private fun finish(ending: Recording) {
        recording = null
        ending.use {
            it.stop()
            write(it, Path.of(checkNotNull(path)))
        }
    }

    /** Writes [target] atomically. */
    private fun write(source: Recording, target: Path) {
        val part = target.resolveSibling("${target.fileName}.part")
        try {
            source.dump(part)
            Files.move(part, target, REPLACE_EXISTING)
        } finally {
            Files.deleteIfExists(part)
        }
        written++
        shim.log(LogLevel.INFO, "flight recording written to $target (${Files.size(target) / KIB} KiB)")
    }

    private companion object {
        const val KIB = 1024

        /** Maximum size of a recording. JFR then drops the oldest events, so a forgotten recording does not fill the disk. */
        const val MAX_BYTES = 512L shl 20
    }
}
