#include "engine.h"

#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include "child.h"
#include "error.h"
#include "log.h"
#include "prim.h"
#include "text.h"

/* This is large enough for deeply nested class loading and static initialisers. */
#define STACK_BYTES ((size_t)16 * 1024 * 1024)

static struct {
    prim_semaphore turn;    /* 1 while no caller has the turn, which is the right to use the data that the turn guards */
    prim_semaphore request; /* posted when `work` is set */
    prim_semaphore done;    /* posted when `work` or the JVM has ended */
    bool started;           /* the engine thread has been started; guarded by the turn, like `work` */
    engine_work *work;
    int32_t result;
    char error[ERROR_CAPACITY];
    atomic_bool busy; /* `work` has not ended */

    atomic_int state;
    atomic_flag losing;
    atomic_bool forked;
    char reason[ERROR_CAPACITY]; /* written once, before the state is LOST */
    _Atomic uint64_t signal_repairs;
} engine = {.losing = ATOMIC_FLAG_INIT};

static _Thread_local bool is_engine;

/* Sets the state to lost in a forked child, which has no engine thread. Must not lock anything, because a thread that exists only in the parent may
 * hold the lock. */
static void lose_in_child(void) {
    atomic_store(&engine.forked, true);
    if (engine_state() != CLK_STATE_RUNNING || atomic_flag_test_and_set(&engine.losing)) return;
    snprintf(engine.reason, sizeof engine.reason, "this process was forked from the one that runs the JVM; use the parent, or call exec");
    engine_set_state(CLK_STATE_LOST);
}

/* Runs when the library is loaded. */
__attribute__((constructor)) static void init(void) {
    prim_semaphore_init(&engine.turn, 1);
    prim_semaphore_init(&engine.request, 0);
    prim_semaphore_init(&engine.done, 0);
    prim_at_fork(lose_in_child);
}

/* ---- State ----------------------------------------------------------------------------------------------------------- */

int32_t engine_state(void) { return atomic_load_explicit(&engine.state, memory_order_acquire); }

int32_t clk_jvm_state(void) { return engine_state(); }

void engine_set_state(int32_t state) {
    int before = atomic_load(&engine.state);
    while (before != CLK_STATE_LOST && !atomic_compare_exchange_weak(&engine.state, &before, state)) {
    }
    /* Wakes the caller that waits for work. When it leaves its turn, the callers that wait for the turn wake up one after the other. */
    if (state != CLK_STATE_RUNNING) prim_semaphore_post(&engine.done);
}

void engine_reset(void) {
    while (prim_semaphore_try(&engine.done)) { /* engine_set_state may have posted it when no caller was waiting */
    }
    atomic_store(&engine.state, CLK_STATE_NONE);
    atomic_flag_clear(&engine.losing);
}

int32_t engine_check_running(void) {
    bool again = child_is_used() && !engine_is_forked();
    switch (engine_state()) {
        case CLK_STATE_RUNNING: return CLK_OK;
        case CLK_STATE_LOST:
            return error_set(CLK_JVM_LOST, "the JVM has crashed or stopped responding (%s); %s", engine.reason,
                             again ? "start it again" : "restart the process");
        case CLK_STATE_STOPPED:
            return error_set(CLK_JVM_NOT_RUNNING, again
                                                      ? "the JVM was stopped; start it again"
                                                      : "the JVM was stopped, and a process can start one only once; restart the process");
        default: return error_set(CLK_JVM_NOT_RUNNING, "no JVM was started; call clk_jvm_start first");
    }
}

void engine_lose(const char *format, ...) {
    if (atomic_flag_test_and_set(&engine.losing)) return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(engine.reason, sizeof engine.reason, format, arguments);
    va_end(arguments);
    log_format(CLK_LOG_ERROR, "the JVM has crashed or stopped responding: %s", engine.reason);
    engine_set_state(CLK_STATE_LOST);
}

/* ---- Turns ----------------------------------------------------------------------------------------------------------- */

int32_t engine_enter(int64_t deadline) {
    if (prim_semaphore_wait_until(&engine.turn, deadline)) return CLK_OK;
    return error_set(CLK_TIMEOUT, "the engine was busy with another call until the time limit and did not execute this one; retry");
}

void engine_leave(void) { prim_semaphore_post(&engine.turn); }

/* ---- Work ------------------------------------------------------------------------------------------------------------ */

void engine_adopt(void) { is_engine = true; }

bool engine_is_current(void) { return is_engine; }

bool engine_is_forked(void) { return atomic_load(&engine.forked); }

static void engine_main(void) {
    is_engine = true;
    for (;;) {
        prim_semaphore_wait(&engine.request);
        engine.result = engine.work();
        if (engine.result != CLK_OK) text_export(error_last(), engine.error, sizeof engine.error);
        atomic_store(&engine.busy, false);
        prim_semaphore_post(&engine.done);
    }
}

uint64_t engine_signal_repairs(void) { return atomic_load_explicit(&engine.signal_repairs, memory_order_relaxed); }

/* Restores HotSpot's signal handlers, without which Java code can end the process. The check needs four system calls, less than a microsecond. */
static void repair_signals(void) {
    int32_t repaired = prim_signals_repair();
    if (repaired == 0) return;
    atomic_fetch_add_explicit(&engine.signal_repairs, (uint64_t)repaired, memory_order_relaxed);
    log_format(CLK_LOG_WARNING, "another library had replaced %d signal handlers of the JVM; they were restored", repaired);
}

int32_t engine_begin(engine_work *work) {
    if (atomic_load(&engine.busy)) return error_set(CLK_TIMEOUT, "the engine is busy with work that exceeded its limit; retry later");
    if (engine_state() == CLK_STATE_RUNNING) repair_signals();
    if (!engine.started) {
        engine.started = prim_thread_start(engine_main, "collektive", STACK_BYTES);
        if (!engine.started)
            return error_set(CLK_MEMORY, "cannot create the JVM thread (16 MB stack); free memory or raise the thread limit");
    }
    engine.work = work;
    atomic_store(&engine.busy, true);
    prim_semaphore_post(&engine.request);
    return CLK_OK;
}

int32_t engine_await(int64_t deadline) {
    while (prim_semaphore_wait_until(&engine.done, deadline)) {
        if (!atomic_load(&engine.busy)) return engine.result == CLK_OK ? CLK_OK : error_set(engine.result, "%s", engine.error);
        int32_t running = engine_check_running();
        if (running != CLK_OK) return running; /* woken by engine_set_state, not by finished work */
    }
    return CLK_TIMEOUT;
}

int32_t engine_run(engine_work *work, int64_t deadline) {
    int32_t result = engine_begin(work);
    if (result == CLK_OK) result = engine_await(deadline);
    return result == CLK_TIMEOUT ? error_set(CLK_TIMEOUT, "the engine thread did not answer within the time limit") : result;
}
