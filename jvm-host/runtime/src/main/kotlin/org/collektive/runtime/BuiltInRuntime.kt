package org.collektive.runtime

import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.RuntimeProvider
import org.collektive.spi.SharingRule

/** Provides the built-in runtime to the host. */
public class BuiltInRuntime : RuntimeProvider {
    override val name: String get() = "builtIn"

    override fun runtimes(rule: SharingRule): DeviceRuntimes = AggregateRuntimes(rule)
}
