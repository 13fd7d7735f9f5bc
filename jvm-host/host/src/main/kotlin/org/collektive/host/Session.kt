package org.collektive.host

import org.collektive.api.schema.DataSchema
import org.collektive.api.schema.MalformedDataException
import org.collektive.engine.Engine
import org.collektive.engine.EngineSettings
import org.collektive.engine.IntList
import org.collektive.engine.NetworkModel
import org.collektive.engine.RoundData
import org.collektive.engine.RoundDigest
import org.collektive.engine.RoundsNotFinished
import org.collektive.engine.Schedule
import org.collektive.engine.TickRefused
import org.collektive.engine.TickResult
import org.collektive.frame.Network
import org.collektive.frame.OpenRequest
import org.collektive.frame.OpenResponse
import org.collektive.frame.ParameterInfo
import org.collektive.frame.ProgramInfo
import org.collektive.frame.RoundError
import org.collektive.frame.StepResponse
import org.collektive.host.jfr.ProgramErrorEvent
import org.collektive.host.jfr.SessionEvents
import org.collektive.host.jfr.SessionStartEvent
import org.collektive.host.record.RecordWriter
import org.collektive.runtime.AggregateRuntimes
import java.io.IOException
import java.nio.ByteBuffer

/** One simulation: its programs, its engine, and the way from its frames to its answers. */
internal class Session private constructor(
    val schema: DataSchema,
    private val programs: Map<String, LoadedProgram>,
    defaultProgram: LoadedProgram?,
    settings: EngineSettings,
    private val shim: ShimCalls,
    private val recorder: RecordWriter?,
) : AutoCloseable {
    private val frame = StepFrame(programs, defaultProgram)
    private val answers = Answers.of(schema, settings.threads)
    private val data = UserData(schema, settings.threads, answers)
    private val globals = if (schema.globalReader() == null) null else GlobalData(schema)
    private val digest = RoundDigest()
    private val buffer = AnswerBuffer(shim)
    private val engine = Engine(settings, AggregateRuntimes(ViewRule))
    private var events = SessionEvents.ofRecorder()
    private var lastEnd = 0L
    private var failure: String? = null

    /** Writes the `OpenResponse`. */
    fun answerOpen(slot: Long, answer: ByteBuffer): Long {
        buffer.begin(slot, answer)
        val builder = buffer.builder
        val infos = programs.values.map { program ->
            val parameters = program.parameters.map {
                ParameterInfo.createParameterInfo(
                    builder,
                    builder.createString(it.name),
                    builder.createString(it.default),
                    builder.createString(it.description),
                )
            }
            val name = builder.createString(program.name)
            ProgramInfo.createProgramInfo(builder, name, ProgramInfo.createParametersVector(builder, parameters.toIntArray()))
        }
        val vector = OpenResponse.createProgramsVector(builder, infos.toIntArray())
        return buffer.finish(OpenResponse.createOpenResponse(builder, vector))
    }

    /**
     * Runs the tick of [request] and writes the `StepResponse`.
     *
     * @param begin when the call came, [deadline] when its limit passes, both in terms of `System.nanoTime()`.
     */
    fun step(request: ByteBuffer, slot: Long, answer: ByteBuffer, begin: Long, deadline: Long): Long {
        failure?.let { throw HostException(HostError.SESSION_FAILED, it) }
        if (recorder == null) return run(request, slot, answer, begin, deadline)
        recording { step(request) }
        val written = try {
            run(request, slot, answer, begin, deadline)
        } catch (e: Throwable) {
            recording { failed(e.message ?: e.toString()) }
            throw e
        }
        val offset = (written ushr Int.SIZE_BITS).toInt()
        recording { done(buffer.memory.limit(offset + written.toInt()).position(offset)) }
        return written
    }

    private fun run(request: ByteBuffer, slot: Long, answer: ByteBuffer, begin: Long, deadline: Long): Long {
        if (events == null) events = SessionEvents.ofRecorder()
        events?.tick?.begin()
        engine.wake()
        frame.read(request)
        readUserData(request)
        val result = try {
            engine.step(frame.tick, data, deadline)
        } catch (e: TickRefused) {
            throw HostException(HostError.FRAME, e.message.orEmpty(), e)
        } catch (e: RoundsNotFinished) {
            shim.log(LogLevel.ERROR, "${e.message}; the threads:")
            e.threads.lineSequence().filter(String::isNotEmpty).forEach { shim.log(LogLevel.ERROR, it) }
            throw fail(e) { "${e.message}; the log shows what each thread was doing. Mend the program, then open a new session" }
        } catch (e: Throwable) {
            throw fail(e) { "tick ${frame.tick.number} failed inside the engine: $e" }
        }
        if (frame.globals != 0) globals?.accept()
        val writeBegin = System.nanoTime()
        val place = try {
            write(result, slot, answer, begin)
        } catch (e: Throwable) {
            throw fail(e) { "the answer of tick ${frame.tick.number} could not be written: $e" }
        }
        val end = System.nanoTime()
        record(result, request.remaining(), place.toInt(), if (lastEnd == 0L) 0 else begin - lastEnd, end - writeBegin)
        recordNetwork(result)
        lastEnd = end
        return place
    }

    override fun close() {
        engine.close()
        (events ?: SessionEvents.ofRecorder())?.end?.let {
            it.ticks = engine.lastTick
            it.failure = failure
            it.commit()
        }
        recorder?.use {
            try {
                it.end()
            } catch (e: IOException) {
                shim.log(LogLevel.ERROR, it.failure(e))
            }
        }
    }

    private inline fun recording(write: RecordWriter.() -> Unit) {
        val recorder = recorder ?: return
        try {
            recorder.write()
        } catch (e: IOException) {
            throw fail(e) { recorder.failure(e) }
        }
    }

    private fun record(result: TickResult, bytesIn: Int, bytesOut: Int, wait: Long, write: Long) {
        val event = events?.tick ?: return
        event.end()
        if (!event.shouldCommit()) return
        event.tick = frame.tick.number
        event.nodes = engine.nodeCount
        event.dueNodes = result.size
        event.failedRounds = result.failureCount
        event.links = engine.linkCount
        event.bytesIn = bytesIn.toLong()
        event.bytesOut = bytesOut.toLong()
        event.wait = wait
        event.rounds = result.roundNanos
        event.write = write
        event.commit()
    }

    /** The session has failed before there are words: with the heap exhausted they cannot be made. */
    private inline fun fail(cause: Throwable, words: () -> String): HostException {
        failure = "memory was short in an earlier tick"
        engine.close()
        val why = words()
        failure = why
        return HostException(HostError.SESSION_FAILED, why, cause)
    }

    private fun readUserData(request: ByteBuffer) {
        val tick = frame.tick
        try {
            data.attach(request, frame.sensors, tick.due)
            if (frame.globals != 0) {
                val holder = globals
                    ?: throw HostException(HostError.FRAME, "the frame has global data, but schema ${schema.name} defines none")
                tick.globals = holder.read(request, frame.globals)
            }
        } catch (e: MalformedDataException) {
            throw HostException(HostError.FRAME, "the frame of tick ${tick.number} is damaged: ${e.message}", e)
        }
    }

    private fun write(result: TickResult, slot: Long, answer: ByteBuffer, begin: Long): Long {
        buffer.begin(slot, answer)
        val builder = buffer.builder
        digest.begin(frame.tick.number)
        val actuators = answers.write(result, buffer, digest)
        digest.end()
        val errors = if (result.failureCount == 0) 0 else writeErrors(result)
        StepResponse.startNodesVector(builder, result.size - result.failureCount)
        // There is room for all, and each is aligned as the one before.
        for (index in result.size - 1 downTo 0) if (result.failure(index) == null) builder.putInt(frame.tick.due[index])
        val nodes = builder.endVector()
        StepResponse.startStepResponse(builder)
        StepResponse.addTick(builder, frame.tick.number)
        StepResponse.addDigest(builder, digest.value)
        StepResponse.addNodes(builder, nodes)
        StepResponse.addActuators(builder, actuators)
        if (errors != 0) StepResponse.addErrors(builder, errors)
        StepResponse.addNodeCount(builder, engine.nodeCount)
        StepResponse.addLinkCount(builder, engine.linkCount)
        val network = result.network
        StepResponse.addSent(builder, count(network.sent))
        StepResponse.addDropped(builder, count(network.dropped))
        StepResponse.addDelayed(builder, count(network.delayed))
        StepResponse.addExpired(builder, count(network.expired))
        StepResponse.addRoundMicros(builder, micros(result.roundNanos))
        StepResponse.addHostMicros(builder, micros(System.nanoTime() - begin))
        return buffer.finish(StepResponse.endStepResponse(builder))
    }

    private fun writeErrors(result: TickResult): Int {
        val builder = buffer.builder
        val errors = (0 until result.size).mapNotNull { index ->
            result.failure(index)?.let { message ->
                record(result, index, message)
                val text = builder.createString(message)
                RoundError.createRoundError(builder, result.id(index), builder.createString(result.program(index).name), text)
            }
        }
        return StepResponse.createErrorsVector(builder, errors.toIntArray())
    }

    private fun recordNetwork(result: TickResult) {
        val event = events?.network ?: return
        if (!event.isEnabled) return
        event.begin() // or it would keep the time of its first use
        event.tick = frame.tick.number
        event.sent = result.network.sent
        event.dropped = result.network.dropped
        event.delayed = result.network.delayed
        event.expired = result.network.expired
        event.commit()
    }

    private fun record(result: TickResult, index: Int, message: String) {
        if (!SessionEvents.wanted) return
        val event = ProgramErrorEvent()
        if (!event.isEnabled) return
        event.tick = frame.tick.number
        event.node = result.id(index)
        event.program = result.program(index).name
        event.message = message
        event.commit()
    }

    private fun micros(nanos: Long) = count(nanos / 1000)

    private fun count(value: Long) = value.coerceAtMost(Int.MAX_VALUE.toLong()).toInt()

    /** The tick's data, each thread with a reader of its own. */
    private class UserData(schema: DataSchema, threads: Int, private val answers: Answers) : RoundData {
        private val readers = Array(threads) { schema.sensorReader() }

        fun attach(request: ByteBuffer, position: Int, due: IntList) {
            answers.begin(due)
            if (position == 0) {
                if (due.size == 0) return
                throw HostException(HostError.FRAME, "the frame has no sensor data, but ${due.size} nodes are due")
            }
            for (reader in readers) reader.attach(request, position)
            val first = readers[0]
            first.check()
            if (first.size != due.size) {
                throw HostException(HostError.FRAME, "the frame has sensor data of ${first.size} nodes, but ${due.size} are due")
            }
        }

        override fun sensors(worker: Int, index: Int): Any = readers[worker][index]

        override fun fault(worker: Int, index: Int, answer: Any): String? = answers.take(worker, index, answer)
    }

    companion object {
        /** Loads what the `OpenRequest` in [frame] asks for. */
        fun open(frame: ByteBuffer, shim: ShimCalls): Session {
            val request = OpenRequest().__assign(FrameVerifier().verify(frame, FrameShapes.openRequest), frame)
            val jars = (0 until request.jarsLength()).map { JarBytes.read(request.jars(it)) }
            val path = request.record().orEmpty()
            return open(request, jars, shim) { if (path.isEmpty()) null else RecordWriter.create(path, frame, jars) }
        }

        /** Loads what [request] asks for with the programs of [jars]; [record] is asked for when all is well so far. */
        fun open(request: OpenRequest, jars: List<JarBytes>, shim: ShimCalls, record: () -> RecordWriter? = { null }): Session {
            val event = if (SessionEvents.wanted) SessionStartEvent() else null
            event?.begin()
            if (request.protocol() != Host.PROTOCOL.toLong()) {
                throw HostException(
                    HostError.HOST,
                    "C# speaks protocol ${request.protocol()}, this host ${Host.PROTOCOL}; use the host jar that came with the package",
                )
            }
            val settings = settings(request)
            val programJars = jars.map(ProgramJar::open)
            val loader = ProgramLoader(programJars)
            val types = (0 until request.typesLength()).associate { request.types(it).let { type -> type.name() to type.hash() } }
            val schemas = SchemaFinder.all(loader, programJars)
            val schema = SchemaFinder.find(request.schema(), types, schemas, programJars)
            val programs = ProgramFinder(programJars, loader, schema, schemas).find()
            val name = request.program().orEmpty()
            val program = if (name.isEmpty()) null else programs[name] ?: throw StepFrame.noSuchProgram("the session", name, programs.keys)
            return Session(schema, programs, program, settings, shim, record()).also {
                if (event == null) return@also
                event.programs = programs.keys.joinToString()
                event.schema = schema.name
                event.schedule = settings.schedule.name
                event.seed = settings.seed
                event.threads = settings.threads
                event.commit()
            }
        }

        private fun network(request: Network?): NetworkModel = if (request == null) {
            NetworkModel()
        } else {
            NetworkModel(
                request.loss(),
                request.lossPerMetre(),
                request.lossPerAttenuation(),
                request.delay(),
                request.jitter(),
                if (request.retention() == 0.0) Double.POSITIVE_INFINITY else request.retention(),
            )
        }

        private fun settings(request: OpenRequest): EngineSettings {
            val schedule = Schedule.entries.getOrNull(request.schedule())
                ?: throw HostException(HostError.FRAME, "there is no schedule ${request.schedule()}")
            return try {
                EngineSettings(request.seed(), request.threads(), schedule, network(request.network()))
            } catch (e: IllegalArgumentException) {
                throw HostException(HostError.FRAME, e.message.orEmpty(), e)
            }
        }
    }
}
