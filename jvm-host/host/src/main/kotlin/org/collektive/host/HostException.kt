package org.collektive.host

/** A failure that the caller can act on; [message] says what happened, to what, and what to do next. */
internal class HostException(val error: HostError, message: String, cause: Throwable? = null) : RuntimeException(message, cause)

/** Those of `CLK_ERRORS` that the host answers with. */
internal enum class HostError(val code: Int) {
    ARGUMENT(-1),
    HANDLE(-3),
    HOST(-11),
    FRAME(-12),
    SCHEMA(-13),
    PROGRAM(-14),
    SESSION_FAILED(-15),
    JAVA(-16),
}
