/* The open sessions, and the slots of their answers. */
#ifndef COLLEKTIVE_SESSION_H
#define COLLEKTIVE_SESSION_H

#include <stdint.h>

/* How long after the caller's limit the host may still answer before the JVM counts as lost. With a full heap on a busy machine, even
 * the text of an error takes seconds. */
#define SESSION_GRACE_MS 10000

/* Removes all sessions and releases their slots, for the end of the JVM. Needs the turn. */
void session_forget_all(void);

/* Sessions open now, and calls of clk_step that reached the host. Any thread. */
int32_t session_count(void);
uint64_t session_steps(void);

#endif
