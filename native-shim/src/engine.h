/*
 * The engine thread, and the state of the JVM that it drives.
 *
 * A caller takes the turn, fills in what its work needs (static data of its own file, which the turn protects), runs the
 * work on the engine thread and leaves the turn. The hand-off is two semaphores and no allocation.
 */
#ifndef COLLEKTIVE_ENGINE_H
#define COLLEKTIVE_ENGINE_H

#include <stdbool.h>
#include <stdint.h>
#include "collektive_shim.h"

/* One of enum clk_jvm_state. */
int32_t engine_state(void);
void engine_set_state(int32_t state);

/* CLK_OK when a JVM runs, else the error with its text. */
int32_t engine_check_running(void);

/* Declares the JVM lost: the first reason counts. Wakes all who wait. Any thread, the JVM's own included. */
__attribute__((format(printf, 1, 2))) void engine_lose(const char *format, ...);

/* Declares that the JVM was stopped from a thread that does not come back. Wakes all who wait. */
void engine_end(void);

/* Takes the turn. CLK_TIMEOUT when the deadline passed first. */
int32_t engine_enter(int64_t deadline);

/* Ends the turn; with work that outlived its caller's patience, as soon as that work ends. */
void engine_leave(void);

/* Runs the work on the engine thread (made at the first call) and returns its result; its error text becomes the caller's.
 * CLK_JVM_LOST when the JVM is lost meanwhile. CLK_TIMEOUT when the deadline passed first: the work goes on alone, so what
 * it uses must stay as it is. Work itself returns neither of the two. */
typedef int32_t engine_work(void);
int32_t engine_run(engine_work *work, int64_t deadline);

/* Whether the engine thread is at work, or was when it was lost. */
bool engine_is_busy(void);

/* Whether the calling thread is the engine thread. */
bool engine_is_current(void);

#endif
