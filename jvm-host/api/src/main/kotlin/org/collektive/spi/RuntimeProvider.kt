package org.collektive.spi

/** An implementation of the Collektive API. The host finds it by `ServiceLoader` among the library jars of a session. */
public interface RuntimeProvider {
    /** Its name in settings, manifests and records. */
    public val name: String

    /** Makes the devices of one session; [rule] says what its programs must not share. */
    public fun runtimes(rule: SharingRule): DeviceRuntimes
}
