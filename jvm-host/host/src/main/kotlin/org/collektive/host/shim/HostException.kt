package org.collektive.host.shim

/** A failure that the user can fix; [message] states what happened, to what, and what to do next. */
public class HostException(public val error: HostError, message: String, cause: Throwable? = null) : RuntimeException(message, cause)

/** The codes of `CLK_ERRORS` (collektive_shim.h) that the host returns. */
public enum class HostError(public val code: Int) {
    ARGUMENT(-1),
    HANDLE(-3),
    HOST(-11),
    FRAME(-12),
    SCHEMA(-13),
    PROGRAM(-14),
    SESSION_FAILED(-15),
    JAVA(-16),
}
