package org.collektive.runtime

import org.collektive.spi.Conversion
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.SharingRule
import org.collektive.spi.StoredValues

/** The built-in runtime. Devices of one process read each other's messages in place. */
public class AggregateRuntimes(private val rule: SharingRule = SharingRule { null }) : DeviceRuntimes {
    private val paths = PathTree()
    private val stacks = ThreadLocal.withInitial { PathStack(paths) }

    override fun device(id: Int): DeviceRuntime = AggregateDevice(id, paths, stacks, rule)

    override fun freeUnused(devices: List<DeviceRuntime>) {
        if (paths.needsSweep) keepUsed(devices)
    }

    override fun convert(devices: List<DeviceRuntime>, conversion: Conversion): StoredValues {
        val converted = ConvertedPaths(paths, conversion)
        var stored = 0
        for (device in devices) stored += (device as AggregateDevice<*>).countStored()
        for (device in devices) (device as AggregateDevice<*>).convert(converted)
        keepUsed(devices)
        return StoredValues(stored, devices.sumOf { (it as AggregateDevice<*>).countStored() })
    }

    private fun keepUsed(devices: List<DeviceRuntime>) {
        paths.keepOnly { keep ->
            for (device in devices) (device as AggregateDevice<*>).forEachPath(keep)
        }
    }
}
