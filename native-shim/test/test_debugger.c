/* Tests with a debugger that stops the JVM. Shim.debugger reports a debugger, and a step that sleeps simulates the stop. */
#include <stddef.h>
#include "test.h"

#define STOPPED_MS 900

static clk_session session;

static int32_t wait_for_call(void) {
    int32_t result;
    while ((result = clk_session_wait(session, 0, &answer)) == CLK_PENDING) sleep_ms(1);
    return result;
}

/* Steps and waits for the result, because on a busy machine any step may be pending. */
static int32_t whole_step(enum command command, int32_t argument) {
    int32_t result = step(session, command, argument, 60000);
    return result == CLK_PENDING ? wait_for_call() : result;
}

/* Attaches a debugger, which then stops a step, and returns the result of this step. */
static int32_t step_stopped(void) {
    CHECK_OK(whole_step(DEBUG, 1));
    int64_t begin = now_ns();
    int32_t result = step(session, SLEEP, STOPPED_MS, 10);
    CHECK(now_ns() - begin < STOPPED_MS * 1000000L);
    return result;
}

static void start_with_session(void) {
    start_plain();
    CHECK_OK(open_session(&session));
}

void debugged_steps_are_pending(void) {
    clk_session other;
    clk_memory memory = {.size = sizeof memory};
    start_with_session();
    CHECK_OK(step(session, SLEEP, 300, 60000)); /* without a debugger, a long step is not pending */
    CHECK_CODE(CLK_ARGUMENT, "no pending call", clk_session_wait(session, 0, &answer));
    CHECK_CODE(CLK_PENDING, NULL, step_stopped());
    CHECK_CODE(CLK_PENDING, NULL, clk_session_wait(session, 10, &answer));
    CHECK_CODE(CLK_TIMEOUT, "continue the program", step(session, EMPTY, 0, 60000));
    CHECK_CODE(CLK_TIMEOUT, "continue the program", open_session(&other));
    CHECK_CODE(CLK_TIMEOUT, "continue the program", clk_control(request, 0, 8, 60000, &answer));
    CHECK_CODE(CLK_ARGUMENT, "in use", clk_slot_grow(request, request_memory.capacity * 2, 0, &memory));
    CHECK_CODE(CLK_ARGUMENT, "wait_ms is -1", clk_session_wait(session, -1, &answer));
    CHECK_CODE(CLK_HANDLE, NULL, clk_session_wait(session + 1, 0, &answer));
    CHECK_OK(wait_for_call());
    CHECK(answer.length == 0 && stats().steps == 3);
    CHECK_CODE(CLK_ARGUMENT, "no pending call", clk_session_wait(session, 0, &answer));
    CHECK_OK(whole_step(GROW, 1 << 20));
    CHECK(answer.length == 1 << 20);
    /* The debugger detaches, and attaches again during a step. */
    CHECK_OK(whole_step(DEBUG, 0));
    CHECK_OK(step(session, SLEEP, 300, 60000));
    CHECK_CODE(CLK_PENDING, NULL, step(session, DEBUG_LATER, 400, 60000));
    CHECK_OK(wait_for_call());
}

/* Begins to open `session`. The command of the open runs longer than the open waits with a debugger. */
static void open_stopped(enum command command, int32_t argument) {
    clk_session first;
    start_plain();
    CHECK_OK(open_session(&first));
    CHECK(step(first, DEBUG, 1, 60000) >= CLK_OK);
    while (clk_session_wait(first, 100, &answer) == CLK_PENDING) {
    }
    int64_t begin = now_ns();
    CHECK_CODE(CLK_PENDING, NULL, open_with(&session, command, argument));
    CHECK(now_ns() - begin < STOPPED_MS * 1000000L && stats().sessions == 2);
    CHECK_CODE(CLK_TIMEOUT, "continue the program", step(first, EMPTY, 0, 60000));
}

void debugged_open_is_pending(void) {
    open_stopped(SLEEP, STOPPED_MS);
    CHECK_CODE(CLK_TIMEOUT, "continue the program", step(session, EMPTY, 0, 60000));
    CHECK_OK(wait_for_call());
    CHECK_OK(whole_step(GROW, 1 << 20));
    CHECK_OK(clk_session_close(session, 60000));
    CHECK(stats().sessions == 1);
}

void debugged_open_fails(void) {
    open_stopped(THROW_LATER, STOPPED_MS);
    CHECK_CODE(CLK_JAVA, "thrown in the host", wait_for_call());
    CHECK(stats().sessions == 1);
    CHECK_CODE(CLK_HANDLE, NULL, clk_session_wait(session, 0, &answer));
    CHECK_CODE(CLK_HANDLE, NULL, clk_session_close(session, 60000));
    CHECK_OK(open_session(&session));
}

void debugged_open_is_closed(void) {
    open_stopped(SLEEP, STOPPED_MS);
    CHECK_OK(clk_session_close(session, 60000));
    CHECK(stats().sessions == 1);
    sleep_ms(STOPPED_MS);
    CHECK_OK(open_session(&session));
    CHECK(stats().sessions == 2 && stats().slots == 3);
}

void debugged_session_is_closed(void) {
    clk_session other;
    start_with_session();
    CHECK_CODE(CLK_PENDING, NULL, step_stopped());
    CHECK_OK(clk_session_close(session, 60000));
    CHECK(stats().sessions == 0);
    CHECK_CODE(CLK_HANDLE, "already closed", clk_session_close(session, 60000));
    CHECK_CODE(CLK_HANDLE, "already closed", clk_session_wait(session, 0, &answer));
    CHECK_OK(clk_slot_release(request));
    CHECK_OK(clk_slot_acquire(100, &request, &request_memory));
    CHECK_CODE(CLK_TIMEOUT, "a debugger has stopped the JVM", open_session(&other));
    for (int i = 0; i < 2 * STOPPED_MS / 100 && clk_control(request, 0, 8, 60000, &answer) == CLK_TIMEOUT; i++) sleep_ms(100);
    CHECK_OK(open_session(&session));
    CHECK_OK(whole_step(EMPTY, 0));
    CHECK(stats().sessions == 1 && stats().slots == 3);
    CHECK_OK(clk_session_close(session, 60000));
}

void debugged_jvm_is_lost(void) {
    start_with_session();
    CHECK_CODE(CLK_PENDING, NULL, step_stopped());
    CHECK_OK(wait_for_call());
    CHECK_CODE(CLK_PENDING, NULL, step(session, CRASH_LATER, STOPPED_MS, 10));
    CHECK_CODE(CLK_JVM_LOST, "crash", wait_for_call());
    if (placement == CLK_IN_PROCESS) return;
    start_plain();
    CHECK_OK(open_session(&session));
    CHECK_OK(step(session, SLEEP, 300, 60000)); /* the new JVM has no debugger */
}

void debugged_jvm_is_stopped(void) {
    start_with_session();
    CHECK_CODE(CLK_PENDING, NULL, step_stopped());
    CHECK_OK(clk_session_close(session, 60000));
    CHECK_CODE(CLK_TIMEOUT, own_or("a debugger has stopped the JVM", "it is still running"), clk_jvm_stop(10));
    if (placement == CLK_IN_PROCESS) sleep_ms(STOPPED_MS);
    if (placement == CLK_IN_PROCESS) CHECK_OK(clk_jvm_stop(60000));
    CHECK(clk_jvm_state() == CLK_STATE_STOPPED && stats().sessions == 0);
}

/* The step takes longer than its limit and the grace period. */
void debugging_has_no_limit(void) {
    start_with_session();
    CHECK_OK(whole_step(DEBUG, 1));
    CHECK_CODE(CLK_PENDING, NULL, step(session, SLEEP, 11000, 10));
    CHECK_OK(wait_for_call());
}
