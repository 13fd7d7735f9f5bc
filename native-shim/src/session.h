/* The open sessions, and the slots of their answers. */
#ifndef COLLEKTIVE_SESSION_H
#define COLLEKTIVE_SESSION_H

#include <stdint.h>

/* Grace period after the caller's limit, before the JVM counts as lost. With a full heap on a busy machine, even composing an error text takes
 * seconds. */
#define SESSION_GRACE_MS 10000

/* Completes the call that a debugger has stopped, unless its caller still waits for it. Needs the turn. CLK_TIMEOUT if it has not ended. The
 * deadline is for closing its session. */
int32_t session_complete(int64_t deadline);

/* Removes all sessions and releases their slots when the JVM ends. Needs the turn. */
void session_remove_all(void);

/* Return the number of open sessions, and of calls of clk_step that reached the host. Any thread. */
int32_t session_count(void);
uint64_t session_steps(void);

#endif
