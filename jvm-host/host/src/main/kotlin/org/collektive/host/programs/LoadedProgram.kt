package org.collektive.host.programs

import org.collektive.api.Device
import org.collektive.api.Parameters
import org.collektive.api.Program
import org.collektive.engine.NodeProgram
import org.collektive.engine.RoundDevice
import org.collektive.frames.session.constants
import org.collektive.host.jfr.RoundSampling
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import java.lang.invoke.MethodHandle
import java.lang.invoke.MethodType

/**
 * A program from a user's jar, ready to run.
 *
 * [function] has exactly the type [TYPE], so `invokeExact` works and does not allocate. A generated lambda would be slightly faster, but
 * `LambdaMetafactory` does not support classes of another class loader.
 *
 * @property info the annotation of the program.
 * @property place the class and method of the program, for profiles.
 */
internal class LoadedProgram(
    val info: Program,
    private val function: MethodHandle,
    private val place: String,
    private val loader: ClassLoader,
) : NodeProgram {
    override val name: String get() = info.name

    private val constants = info.parameters.associate { it.name to it.constants }

    private val defaults = Parameters(info.parameters.associate { it.name to it.default })

    init {
        for (declared in info.parameters) {
            checkConstant(declared.name, declared.default) { "program '$name': the default of the parameter '${declared.name}' is" }
        }
    }

    override fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any? {
        val argument: Device = device // invokeExact needs this static type
        val event = RoundSampling.begin() ?: return function.invokeExact(aggregate, sensors, argument)
        try {
            return function.invokeExact(aggregate, sensors, argument)
        } finally {
            RoundSampling.end(event, device, name, place)
        }
    }

    override fun describe(failure: Throwable, place: String?): String = RoundFailure.describe(failure, place, loader)

    /**
     * Returns the parameters of [node], which overrides [values].
     *
     * @throws HostException when a value is not a number although its default is one, not a constant of the parameter's enum class, or its
     * parameter is not declared.
     */
    fun parameters(node: Int, values: Map<String, String>): Parameters {
        if (values.isEmpty()) return defaults
        val all = info.parameters.associateTo(LinkedHashMap()) { it.name to it.default }
        for ((name, value) in values) {
            if (name !in all) {
                throw HostException(
                    HostError.PROGRAM,
                    "node $node sets the parameter '$name', which program '${this.name}' does not declare; it declares ${all.keys}",
                )
            }
            if (all.getValue(name).toDoubleOrNull() != null && value.toDoubleOrNull() == null) {
                throw HostException(
                    HostError.PROGRAM,
                    "node $node sets the parameter '$name' of program '${this.name}' to '$value': it must be a number like its default ${all[name]}",
                )
            }
            checkConstant(name, value) { "node $node sets the parameter '$name' of program '${this.name}' to" }
            all[name] = value
        }
        return Parameters(all)
    }

    private inline fun checkConstant(name: String, value: String, subject: () -> String) {
        val possible = constants.getValue(name)
        if (possible.isEmpty() || value in possible) return
        throw HostException(HostError.PROGRAM, "${subject()} '$value': it must be one of $possible")
    }

    companion object {
        /** The erased type of all programs with the parameters aggregate, sensors and device. */
        val TYPE: MethodType = MethodType.methodType(Any::class.java, Any::class.java, Any::class.java, Device::class.java)
    }
}
