package org.collektive.host

/** Main class of a JVM in a separate process. The shim passes the path of its library and a token for the shared memory. */
public object Main {
    // As large as the stack of the engine thread in the caller's process.
    private const val STACK_BYTES = 16L shl 20

    /** Serves calls until the shim stops the JVM. Returns at once, so that the JVM does not wait for its main thread. */
    @JvmStatic
    public fun main(arguments: Array<String>) {
        require(arguments.size == 2) { "only the shim starts this class, for a JVM in a separate process" }
        System.load(arguments[0])
        Thread(null, { serve(arguments[1]) }, "collektive", STACK_BYTES).start()
    }

    @JvmStatic
    private external fun serve(token: String)
}
