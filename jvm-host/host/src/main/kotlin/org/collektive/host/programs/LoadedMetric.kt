package org.collektive.host.programs

import org.collektive.api.NetworkSnapshot
import org.collektive.frames.tick.MetricOutcome
import java.lang.invoke.MethodHandle
import java.lang.invoke.MethodType

/** A metric of a user's jar. [function] has exactly the type [TYPE]. */
internal class LoadedMetric(val name: String, private val function: MethodHandle, private val loader: ClassLoader) {
    /** Evaluates the metric, and catches everything that it throws. */
    fun measure(network: NetworkSnapshot<Any, Any>): MetricOutcome = try {
        MetricOutcome(function.invokeExact(network) as Double, null)
    } catch (failure: Throwable) {
        MetricOutcome(Double.NaN, RoundFailure.describe(failure, null, loader))
    }

    companion object {
        /** The erased type of all metrics. */
        val TYPE: MethodType = MethodType.methodType(Double::class.javaPrimitiveType, NetworkSnapshot::class.java)
    }
}
