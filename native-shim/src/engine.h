/*
 * The engine thread, which runs all calls of Java, and the state of the JVM.
 *
 * Callers take turns, so only one of them at a time has the turn. It stores the input of its work in static data that the turn guards, runs the
 * work on the engine thread, and leaves the turn. Two semaphores pass the work to the thread and back, without an allocation.
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

/* Sets the state, unless it is CLK_STATE_LOST, which only engine_reset changes. Callers that wait detect that the JVM is lost or stopped. */
void engine_set_state(int32_t state);

/* Returns CLK_OK if a JVM is running. Otherwise, sets and returns an error with the reason. */
int32_t engine_check_running(void);

/* Sets the state to lost, with a reason. If the JVM is already lost, does nothing. */
__attribute__((format(printf, 1, 2))) void engine_lose(const char *format, ...);

/* Sets the state to none, even after a loss, so that another JVM can start in a separate process. Needs the turn. */
void engine_reset(void);

/* Waits for the turn and takes it. Returns CLK_TIMEOUT if the deadline passes first. */
int32_t engine_enter(int64_t deadline);

void engine_leave(void);

/* Begins `work` on the engine thread, which the first call starts. Needs the turn. Returns CLK_TIMEOUT if earlier work is still running. */
typedef int32_t engine_work(void);
int32_t engine_begin(engine_work *work);

/* Waits for the work, copies its error to the calling thread and returns its result. Needs the turn. Returns CLK_JVM_LOST if the JVM is lost
 * meanwhile. Returns CLK_TIMEOUT if the deadline passes first: the work continues, so call this function again, or engine_lose. The work itself
 * returns neither of these codes. */
int32_t engine_await(int64_t deadline);

/* Begins the work and waits for it. */
int32_t engine_run(engine_work *work, int64_t deadline);

/* Returns whether this process is a fork of the process that loaded the shim. */
bool engine_is_forked(void);

/* Makes the calling thread the engine thread of the JVM's own process. */
void engine_adopt(void);

/* Returns whether the calling thread is the engine thread. */
bool engine_is_current(void);

/* Returns the number of signal handlers of HotSpot that the shim has restored so far. */
uint64_t engine_signal_repairs(void);

#endif
