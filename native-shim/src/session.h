/* Sessions: which simulations the JVM holds, and the slots of their answers. */
#ifndef COLLEKTIVE_SESSION_H
#define COLLEKTIVE_SESSION_H

#include <stdint.h>

/* The time that the host gets to answer after the caller's limit, before the JVM counts as lost. On a busy machine it may be long until a full
 * heap gives room for the words of the answer. */
#define SESSION_GRACE_MS 10000

/* Forgets all sessions and gives their slots back: the JVM is gone. Under the turn. */
void session_forget_all(void);

int32_t session_count(void);
uint64_t session_steps(void);
uint64_t session_signal_repairs(void);

#endif
