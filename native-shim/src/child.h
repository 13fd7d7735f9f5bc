/*
 * The JVM in a separate process, the child, seen from the caller's process. Each child has a thread here, which starts it, reads its output and waits
 * for its end. A caller must have the turn (see engine.h) to call these functions, unless stated otherwise.
 */
#ifndef COLLEKTIVE_CHILD_H
#define COLLEKTIVE_CHILD_H

#include <stdbool.h>
#include <stdint.h>
#include "host.h"
#include "launch.h"

/* Returns whether the last start was in a separate process. Any thread. */
bool child_is_used(void);
void child_use(bool used);

/* Starts the child and copies the version line of the host. After an error, call child_end. */
int32_t child_start(const struct launch *launch, int64_t deadline, char *version, int32_t capacity);

/* Returns whether the child still runs. If it has ended unexpectedly, sets the state from running to lost. */
bool child_is_alive(void);

/* Begins a call in the child, which runs it with host_run. */
int32_t child_begin(const struct host_call *call);

/* Waits for the call with the results of engine_await. */
int32_t child_await(struct host_call *call, int64_t deadline);

/* Shuts down the child's JVM. Returns CLK_TIMEOUT if the child has not ended by the deadline. Call child_end afterwards in both cases. */
int32_t child_stop(int32_t limit_ms, int64_t deadline);

/* Kills the child if it is still running, waits for its end and frees its resources. Returns CLK_TIMEOUT if the system does not end it. */
int32_t child_end(void);

/* Returns the process id of the child of the last start, or 0 if that start was in this process. Any thread. */
int32_t child_process(void);
#endif
