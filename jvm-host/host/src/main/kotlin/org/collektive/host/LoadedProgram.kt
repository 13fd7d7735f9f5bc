package org.collektive.host

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.impl.ProgramPlace
import it.unibo.collektive.aggregate.api.impl.told
import org.collektive.api.Device
import org.collektive.api.Parameters
import org.collektive.api.Program
import org.collektive.engine.NodeProgram
import org.collektive.engine.UnusableAnswer
import org.collektive.host.jfr.ProgramRounds
import org.collektive.runtime.DeviceRuntime
import java.lang.invoke.MethodHandle
import java.lang.invoke.MethodType

/**
 * A program of a user's jar, ready to be called.
 *
 * The [function] has exactly the type of [TYPE], so that a call allocates nothing. A generated lambda would be a little cheaper, but the JDK
 * makes none for a class of another loader: the lookup lacks the right of its module.
 *
 * @property place class and method, for profiles.
 */
internal class LoadedProgram(private val info: Program, private val function: MethodHandle, private val place: String) : NodeProgram {
    override val name: String get() = info.name

    /** Name, default and description of each parameter. */
    val parameters get() = info.parameters.asList()

    private val defaults = Parameters(parameters.associate { it.name to it.default })

    override fun round(aggregate: Aggregate<Int>, sensors: Any?, device: Device): Any? {
        val event = ProgramRounds.begin() ?: return function.invokeExact(aggregate, sensors, device)
        try {
            return function.invokeExact(aggregate, sensors, device)
        } finally {
            ProgramRounds.end(event, device, name, place, (aggregate as? DeviceRuntime)?.exports ?: 0)
        }
    }

    override fun describe(failure: Throwable, place: ProgramPlace?): String = RoundFailure.describe(failure, place)

    /** The parameters of a node that sets [values]. */
    fun parameters(node: Int, values: Map<String, String>): Parameters {
        if (values.isEmpty()) return defaults
        val all = LinkedHashMap<String, String>()
        for (parameter in parameters) all[parameter.name] = parameter.default
        for ((name, value) in values) {
            if (name !in all) {
                throw HostException(
                    HostError.PROGRAM,
                    "node $node sets the parameter '$name', which program '${this.name}' does not declare; it declares ${all.keys}",
                )
            }
            all[name] = value
        }
        return Parameters(all)
    }

    companion object {
        /** The erased type of all programs. */
        val TYPE: MethodType =
            MethodType.methodType(Any::class.java, Aggregate::class.java, Any::class.java, Device::class.java)
    }
}

/** Why a round failed, for its author: one line, then the stack in the user's code. */
internal object RoundFailure {
    private const val MAX_MESSAGE = 2000
    private const val MAX_FRAMES = 20

    fun describe(failure: Throwable, place: ProgramPlace?): String = buildString {
        append(lineWithPlace(failure, place))
        frames(failure)
        var cause = failure.cause
        var depth = 0
        while (cause != null && depth++ < MAX_CAUSES) {
            append("\ncaused by ").append(line(cause))
            frames(cause)
            cause = cause.cause
        }
    }

    private fun lineWithPlace(failure: Throwable, place: ProgramPlace?): String {
        val line = line(failure)
        // An answer is judged when the program is over, and the runtime's own errors tell their place themselves.
        return if (place == null || failure is UnusableAnswer || place.toString() in line) line else told(line, place)
    }

    private fun line(failure: Throwable): String {
        val text = when (failure) {
            is UnusableAnswer -> failure.message.orEmpty()
            is StackOverflowError -> "$failure: the recursion does not end"
            else -> failure.toString()
        }
        return text.take(MAX_MESSAGE).replace('\n', ' ').replace('\r', ' ')
    }

    private fun StringBuilder.frames(failure: Throwable) {
        val own = failure.stackTrace.filter { it.classLoaderName == ProgramLoader.NAME }
        for (frame in own.take(MAX_FRAMES)) {
            append("\n    at ").append(frame.className).append('.').append(frame.methodName)
            append('(').append(frame.fileName).append(':').append(frame.lineNumber).append(')')
        }
        if (own.size > MAX_FRAMES) append("\n    ... ").append(own.size - MAX_FRAMES).append(" more")
    }

    private const val MAX_CAUSES = 4
}
