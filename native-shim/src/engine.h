/*
 * The engine thread, and the state of the JVM that it drives.
 *
 * One caller at a time has the turn. A caller takes the turn, fills in the input of its work (static data of its file, which the turn
 * guards), runs the work on the engine thread and leaves the turn. The hand-off uses two semaphores and does not allocate.
 *
 * Any thread may call these functions, unless stated otherwise.
 */
#ifndef COLLEKTIVE_ENGINE_H
#define COLLEKTIVE_ENGINE_H

#include <stdbool.h>
#include <stdint.h>
#include "collektive_shim.h"

/* Returns one of enum clk_jvm_state. */
int32_t engine_state(void);

/* Sets the state, unless it is CLK_STATE_LOST, which is final. All waiting callers detect that the JVM is lost or stopped. */
void engine_set_state(int32_t state);

/* Returns CLK_OK if a JVM is running; otherwise sets an error with the reason. */
int32_t engine_check_running(void);

/* Sets the state to lost. Only the first reason is kept. */
__attribute__((format(printf, 1, 2))) void engine_lose(const char *format, ...);

/* Sets the state to none, also after a loss: another JVM may follow in a separate process. Needs the turn. */
void engine_reset(void);

/* Takes the turn. Returns CLK_TIMEOUT if the deadline passed first. */
int32_t engine_enter(int64_t deadline);

void engine_leave(void);

/* Begins `work` on the engine thread, which the first call starts. Needs the turn. Returns CLK_TIMEOUT while earlier work runs. */
typedef int32_t engine_work(void);
int32_t engine_begin(engine_work *work);

/* Waits for the work and returns its result; sets its error for the caller. Needs the turn. Returns CLK_JVM_LOST if the JVM is lost meanwhile,
 * and CLK_TIMEOUT if the deadline passed first: the work continues, so wait again, or lose the JVM. `work` itself returns neither of these
 * codes. */
int32_t engine_await(int64_t deadline);

/* Both in one. */
int32_t engine_run(engine_work *work, int64_t deadline);

/* Returns whether this process was forked from the process that runs the JVM. */
bool engine_is_forked(void);

/* Makes the calling thread the engine thread of the JVM's own process. */
void engine_adopt(void);

/* Returns whether the calling thread is the engine thread. */
bool engine_is_current(void);

/* Returns the number of signal handlers of HotSpot that were restored since the start. */
uint64_t engine_signal_repairs(void);

#endif
