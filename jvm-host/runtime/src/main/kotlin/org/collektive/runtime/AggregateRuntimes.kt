package org.collektive.runtime

import org.collektive.spi.DeviceRuntime
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.SharingRule

/** The built-in runtime. Devices of one process read each other's messages in place. */
public class AggregateRuntimes(private val rule: SharingRule = SharingRule { null }) : DeviceRuntimes {
    private val paths = PathTree()
    private val stacks = ThreadLocal.withInitial { PathStack(paths) }

    override fun device(id: Int): DeviceRuntime = AggregateDevice(id, paths, stacks, rule)

    override fun freeUnused(devices: List<DeviceRuntime>) {
        if (!paths.needsSweep) return
        paths.keepOnly { keep ->
            for (device in devices) (device as AggregateDevice<*>).forEachPath(keep)
        }
    }
}
