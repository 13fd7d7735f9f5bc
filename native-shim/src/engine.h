/*
 * The engine thread, and the state of the JVM that it drives.
 *
 * One caller at a time has the turn. It takes the turn, fills in what its work needs (static data of its own file, which the turn
 * guards), runs the work on the engine thread and leaves the turn. The hand-off is two semaphores and allocates nothing.
 *
 * Any thread may call these functions, unless said otherwise.
 */
#ifndef COLLEKTIVE_ENGINE_H
#define COLLEKTIVE_ENGINE_H

#include <stdbool.h>
#include <stdint.h>
#include "collektive_shim.h"

/* One of enum clk_jvm_state. */
int32_t engine_state(void);

/* A lost JVM stays lost. */
void engine_set_state(int32_t state);

/* CLK_OK when a JVM runs; otherwise sets the error that says why not. */
int32_t engine_check_running(void);

/* Sets the state to lost and wakes all waiting callers. Only the first reason counts. */
__attribute__((format(printf, 1, 2))) void engine_lose(const char *format, ...);

/* Sets the state to stopped and wakes all waiting callers; for a thread that does not return. */
void engine_end(void);

/* Takes the turn. CLK_TIMEOUT when the deadline passed first. */
int32_t engine_enter(int64_t deadline);

/* Leaves the turn. When engine_run timed out, the turn ends with the abandoned work, or with the JVM. */
void engine_leave(void);

/* Runs `work` on the engine thread, which the first call starts, and returns its result; sets its error for the caller. Needs the turn.
 * CLK_JVM_LOST when the JVM is lost meanwhile. CLK_TIMEOUT when the deadline passed first: the work goes on, so the data that it
 * uses must not change. `work` itself returns neither of the two. */
typedef int32_t engine_work(void);
int32_t engine_run(engine_work *work, int64_t deadline);

/* Whether this process was forked from the one that runs the JVM. */
bool engine_is_forked(void);

/* Whether the calling thread is the engine thread. */
bool engine_is_current(void);

/* Signal handlers of HotSpot that were put back since the start. */
uint64_t engine_signal_repairs(void);

#endif
