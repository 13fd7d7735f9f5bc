/* The open sessions, and the slots of their answers. */
#ifndef COLLEKTIVE_SESSION_H
#define COLLEKTIVE_SESSION_H

#include <stdint.h>

/* Time after the caller's limit until the JVM counts as lost. The host needs it to report the time-out: with a full heap on a busy machine, even
 * composing an error text takes seconds. */
#define SESSION_GRACE_MS 10000

/* Completes a call that a debugger had stopped and whose caller no longer waits for it. Needs the turn. Returns CLK_TIMEOUT if a stopped call has not
 * ended, or if its caller must still wait for it with clk_session_wait. If the caller has closed the session, closes it by the deadline. */
int32_t session_complete(int64_t deadline);

/* Removes all sessions and releases their slots when the JVM ends. Needs the turn. */
void session_remove_all(void);

/* These functions return the number of open sessions, and the number of calls of clk_step that reached the host. Any thread. */
int32_t session_count(void);
uint64_t session_steps(void);

#endif
