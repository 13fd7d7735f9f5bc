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
 * The flight recording of this JVM; there is at most one.
 *
 * Actions run one after the other on a separate thread, because they are slow: the first start takes some hundred milliseconds. A caller
 * finds their outcome later in [state], [error] and the log. Call the functions from one thread.
 */
internal class Recorder(private val shim: ShimCalls) {
    enum class State { OFF, STARTING, ON, DUMPING, STOPPING }

    private var worker: ExecutorService? = null
    private var recording: Recording? = null

    /** Number of actions that are not done; guarded by this. */
    private var orders = 0

    /** The action requested last, until all actions are done; then [State.ON] or [State.OFF]. */
    @Volatile
    var state = State.OFF
        private set

    /** File of the current recording, or of the last one; `null` before the first. */
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
    fun start(settings: String, file: String) = act(State.STARTING) {
        check(recording == null) { "a recording runs already, to $path; stop it first" }
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

    /** Writes the recording so far to [file], and continues it. */
    fun dump(file: String) = act(State.DUMPING) { write(running(), target(file)) }

    /** Stops the recording and writes its file. */
    fun stop() = act(State.STOPPING) { finish(running()) }

    /** Stops a running recording, and waits for its file for at most [limitMillis] milliseconds. */
    fun close(limitMillis: Int) {
        val worker = worker ?: return
        if (state != State.OFF) act(State.STOPPING) { recording?.let(::finish) }
        worker.shutdown()
        if (!worker.awaitTermination(limitMillis.toLong(), TimeUnit.MILLISECONDS)) {
            shim.log(LogLevel.ERROR, "the flight recording to $path was not written within $limitMillis ms")
        }
        this.worker = null
    }

    private fun act(busy: State, action: () -> Unit) {
        synchronized(this) {
            orders++
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
                // Another action may have been requested meanwhile.
                if (--orders == 0) state = if (recording == null) State.OFF else State.ON
            }
        }
    }

    private fun text(failure: Throwable): String = when (failure) {
        is NoSuchFileException -> "there is no file or folder ${failure.file}"
        is IOException -> "it cannot be written: ${failure.message ?: failure}; make room or choose another file"
        is IllegalStateException, is IllegalArgumentException -> failure.message ?: failure.toString()
        else -> failure.toString()
    }

    private fun running() = checkNotNull(recording) { "none runs; start one first" }

    private fun target(file: String): Path {
        require(file.isNotBlank()) { "name the file it is written to" }
        val target = Path.of(file).toAbsolutePath()
        require(!Files.isDirectory(target)) { "$target is a folder; name a file in it" }
        Files.createDirectories(target.parent)
        return target
    }

    private fun configuration(settings: String): Configuration {
        Configuration.getConfigurations().find { it.name == settings }?.let { return it }
        require(settings.endsWith(".jfc")) {
            val known = Configuration.getConfigurations().map { it.name }.sorted().joinToString()
            "there are no settings '$settings'; there are $known and the paths of .jfc files"
        }
        return try {
            Configuration.create(Path.of(settings))
        } catch (e: ParseException) {
            throw IllegalArgumentException("$settings is no file of recording settings: ${e.message}", e)
        }
    }

    private fun finish(ending: Recording) {
        recording = null
        ending.use {
            it.stop()
            write(it, Path.of(checkNotNull(path)))
        }
    }

    /** Writes atomically: [target] exists completely or not at all. */
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

        /** Limit of a recording: JFR then drops the oldest events, so that a forgotten recording does not fill the disk. */
        const val MAX_BYTES = 512L shl 20
    }
}
