package org.collektive.host.session

import org.collektive.engine.Engine
import org.collektive.engine.EngineSettings
import org.collektive.engine.NetworkModel
import org.collektive.engine.Schedule
import org.collektive.frame.Network
import org.collektive.frame.OpenRequest
import org.collektive.frames.data.ViewRule
import org.collektive.frames.session.openRequest
import org.collektive.host.jfr.SessionEvents
import org.collektive.host.jfr.SessionStartEvent
import org.collektive.host.library.AggregateLibrary
import org.collektive.host.library.AggregateRuntime
import org.collektive.host.programs.JarBytes
import org.collektive.host.programs.Programs
import org.collektive.host.record.RecordWriter
import org.collektive.host.shim.Debugger
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import org.collektive.host.shim.ShimCalls
import java.nio.ByteBuffer

/** Opens a [Session] as an `OpenRequest` describes it. */
public object SessionOpening {
    /** Version of the protocol: `schema/frame.fbs` and the entry points of [org.collektive.host.Host]. */
    public const val PROTOCOL: Int = 1

    /** Opens the session of the `OpenRequest` between position and limit of [frame], and creates its record if requested. */
    internal fun open(frame: ByteBuffer, shim: ShimCalls): Session {
        val request = reading { openRequest(frame) }
        val jars = (0 until request.jarsLength()).map { JarBytes.read(request.jars(it)) }
        val path = request.record().orEmpty()
        return open(request, jars, shim) { if (path.isEmpty()) null else RecordWriter.create(path, frame, jars) }
    }

    /**
     * Opens the session of [request], a verified frame, with the programs of [jars].
     *
     * @param readJars reads the jars of a later reload from their paths.
     * @param record creates the session's record; called last, so that a failed opening does not overwrite a file.
     * @throws HostException when the library, the programs or their schema cannot be loaded, or a setting is out of range.
     */
    public fun open(
        request: OpenRequest,
        jars: List<JarBytes>,
        shim: ShimCalls,
        readJars: (List<String>) -> List<JarBytes> = { it.map(JarBytes::read) },
        record: () -> RecordWriter?,
    ): Session {
        val event = if (SessionEvents.isRecorderInitialized) SessionStartEvent() else null
        event?.begin()
        if (request.protocol() != PROTOCOL.toLong()) {
            throw HostException(
                HostError.HOST,
                "C# uses protocol version ${request.protocol()}, but this host uses version $PROTOCOL; use the host jar of the package",
            )
        }
        val settings = settings(request)
        val library = AggregateLibrary.of(AggregateRuntime.of(request.runtime()), request.runtimeJars().orEmpty())
        val source = ProgramSource(library, request)
        val programs = source.load(jars)
        return Engine(settings, library.runtimes(ViewRule), Debugger).orClose { engine ->
            record().orClose { writer ->
                val reload = ProgramReload(source, engine, settings.threads, readJars)
                Session(LoadedPrograms(programs, settings.threads), reload, engine, shim, writer).also {
                    if (event != null) commit(event, programs, settings)
                }
            }
        }
    }

    private fun commit(event: SessionStartEvent, programs: Programs, settings: EngineSettings) {
        event.programs = programs.infos.joinToString { it.name }
        event.schema = programs.schema.name
        event.schedule = settings.schedule.name
        event.seed = settings.seed
        event.threads = settings.threads
        event.commit()
    }

    private fun settings(request: OpenRequest): EngineSettings {
        val schedule = Schedule.entries.getOrNull(request.schedule())
            ?: throw HostException(HostError.FRAME, "unknown schedule ${request.schedule()}")
        return try {
            EngineSettings(
                request.seed(),
                request.threads(),
                schedule,
                network(request.network()),
                keepsAnswers = request.metricsLength() > 0,
            )
        } catch (e: IllegalArgumentException) {
            throw HostException(HostError.FRAME, e.message.orEmpty(), e)
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
            request.burstShare(),
            request.burstLength(),
            request.burstLoss(),
        )
    }
}
