package org.collektive.runtime

import org.collektive.spi.DeviceRuntime
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.SharingRule

/** The project's own runtime: devices of one process that read each other's messages in place. */
public class AggregateRuntimes(private val rule: SharingRule = SharingRule { null }) : DeviceRuntimes {
    private val paths = PathTree()
    private val stacks = ThreadLocal.withInitial { PathStack(paths) }

    override fun device(id: Int): DeviceRuntime = AggregateDevice(id, paths, stacks, rule)

    override fun tidy(devices: List<DeviceRuntime>) {
        if (!paths.isCrowded) return
        paths.keepOnly { keep ->
            for (device in devices) (device as AggregateDevice<*>).forEachPath(keep)
        }
    }
}
