#include "engine.h"

#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include "error.h"
#include "log.h"
#include "prim.h"

/* User code runs on pool threads of the JVM; the host's own code and deep class loading run here. */
#define STACK_BYTES ((size_t)16 * 1024 * 1024)

/* Of the command: the caller gave up waiting (ABANDONED), and then left its turn (HANDED_OVER) for the engine to leave. */
enum phase { IDLE, BUSY, ABANDONED, HANDED_OVER };

static struct {
    prim_once once;
    prim_semaphore turn;    /* one token: who holds it may fill in the command */
    prim_semaphore request; /* a command is there */
    prim_semaphore done;    /* it is done, or the JVM is lost */
    bool started;           /* by the turn */
    engine_work *work;
    int32_t result;
    char error[ERROR_CAPACITY];
    atomic_int phase;

    atomic_int state;
    atomic_flag losing;
    char reason[ERROR_CAPACITY]; /* written once, before the state says LOST */
} engine = {.once = PRIM_ONCE_INIT, .losing = ATOMIC_FLAG_INIT};

static _Thread_local bool is_engine;

/* A forked child has no engine thread: only the calling thread lives on there. No lock may be taken here, as a thread that
 * is not in the child may hold it. */
static void forget_parent(void) {
    if (engine_state() != CLK_STATE_RUNNING || atomic_flag_test_and_set(&engine.losing)) return;
    snprintf(engine.reason, sizeof engine.reason, "this process was forked from the one that runs it");
    engine_set_state(CLK_STATE_LOST);
}

static void init(void) {
    prim_semaphore_init(&engine.turn, 1);
    prim_semaphore_init(&engine.request, 0);
    prim_semaphore_init(&engine.done, 0);
    prim_at_fork(forget_parent);
}

/* ---- State ----------------------------------------------------------------------------------------------------------- */

int32_t engine_state(void) { return atomic_load_explicit(&engine.state, memory_order_acquire); }

int32_t clk_jvm_state(void) { return engine_state(); }

void engine_set_state(int32_t state) {
    /* Lost is for ever. */
    int before = atomic_load(&engine.state);
    while (before != CLK_STATE_LOST && !atomic_compare_exchange_weak(&engine.state, &before, state)) {
    }
}

int32_t engine_check_running(void) {
    switch (engine_state()) {
        case CLK_STATE_RUNNING: return CLK_OK;
        case CLK_STATE_LOST: return error_set(CLK_JVM_LOST, "the JVM is lost, restart the process to get a new one: %s", engine.reason);
        case CLK_STATE_STOPPED:
            return error_set(CLK_JVM_NOT_RUNNING, "the JVM of this process was stopped; a process can start one only once");
        default: return error_set(CLK_JVM_NOT_RUNNING, "no JVM was started; call clk_jvm_start first");
    }
}

/* The one who waits for the engine, and those who wait for their turn, one after the other. */
static void wake_all(void) {
    prim_run_once(&engine.once, init);
    prim_semaphore_post(&engine.done);
    prim_semaphore_post(&engine.turn);
}

void engine_lose(const char *format, ...) {
    if (atomic_flag_test_and_set(&engine.losing)) return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(engine.reason, sizeof engine.reason, format, arguments);
    va_end(arguments);
    engine_set_state(CLK_STATE_LOST);
    log_format(CLK_LOG_ERROR, "the JVM is lost: %s", engine.reason);
    wake_all();
}

void engine_end(void) {
    engine_set_state(CLK_STATE_STOPPED);
    wake_all();
}

/* ---- Turns ----------------------------------------------------------------------------------------------------------- */

int32_t engine_enter(int64_t deadline) {
    prim_run_once(&engine.once, init);
    if (prim_semaphore_wait_until(&engine.turn, deadline)) return CLK_OK;
    return error_set(CLK_TIMEOUT, "the engine was busy with another call for the whole time limit; nothing was done");
}

void engine_leave(void) {
    int abandoned = ABANDONED;
    if (!atomic_compare_exchange_strong(&engine.phase, &abandoned, HANDED_OVER)) prim_semaphore_post(&engine.turn);
}

/* ---- Work ------------------------------------------------------------------------------------------------------------ */

bool engine_is_current(void) { return is_engine; }

bool engine_is_busy(void) { return atomic_load(&engine.phase) != IDLE; }

static void engine_main(void) {
    is_engine = true;
    for (;;) {
        prim_semaphore_wait(&engine.request);
        engine.result = engine.work();
        if (engine.result != CLK_OK) give_text(error_last(), engine.error, sizeof engine.error);
        switch (atomic_exchange(&engine.phase, IDLE)) {
            case BUSY: prim_semaphore_post(&engine.done); break;
            case HANDED_OVER: prim_semaphore_post(&engine.turn); break;
            default: break; /* the caller still has its turn, and leaves it itself */
        }
    }
}

int32_t engine_run(engine_work *work, int64_t deadline) {
    if (!engine.started) {
        engine.started = prim_thread_start(engine_main, "collektive", STACK_BYTES);
        if (!engine.started) return error_set(CLK_MEMORY, "the system gives no thread with a stack of 16 MB for the JVM");
    }
    engine.work = work;
    atomic_store(&engine.phase, BUSY);
    prim_semaphore_post(&engine.request);
    if (!prim_semaphore_wait_until(&engine.done, deadline)) {
        int busy = BUSY;
        if (atomic_compare_exchange_strong(&engine.phase, &busy, ABANDONED)) {
            return error_set(CLK_TIMEOUT, "the engine thread did not answer within the time limit");
        }
        prim_semaphore_wait(&engine.done); /* it finished just now */
    }
    if (atomic_load(&engine.phase) != IDLE) return engine_check_running(); /* woken because the JVM is gone */
    return engine.result == CLK_OK ? CLK_OK : error_set(engine.result, "%s", engine.error);
}
