package org.collektive.host.library

import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException

/**
 * An implementation of the Collektive API that runs aggregate programs.
 *
 * @property key the name in settings, manifests and records.
 * @property title the name in messages.
 * @property jar the jar next to the host's that contains its `RuntimeProvider`.
 */
public enum class AggregateRuntime(public val key: String, public val title: String, internal val jar: String) {
    BUILT_IN("builtIn", "built-in runtime", "collektive-library.jar"),
    COLLEKTIVE("collektive", "Collektive runtime", "collektive-adapter.jar"),
    ;

    public companion object {
        /** Returns the runtime with the number [value] of `AggregateRuntime` in `frame.fbs`. */
        public fun of(value: Int): AggregateRuntime =
            entries.getOrNull(value) ?: throw HostException(HostError.FRAME, "unknown aggregate runtime $value")
    }
}
