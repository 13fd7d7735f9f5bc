package org.collektive.spi

/** An implementation of the Collektive API. The host finds it with `ServiceLoader` in the library jars of a session. */
public interface RuntimeProvider {
    /** The name in settings, manifests and records. */
    public val name: String

    /** Creates the devices of one session; [rule] rejects values that its programs must not share. */
    public fun runtimes(rule: SharingRule): DeviceRuntimes
}
