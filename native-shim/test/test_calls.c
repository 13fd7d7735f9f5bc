#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include "prim.h"
#include "test.h"

/* ---- Answers --------------------------------------------------------------------------------------------------------- */

/* Sends random bytes from a random place in the slot, and checks that the answer contains them. The slot grows if it is too small. */
static void check_echo(clk_session session, clk_slot slot, clk_memory *memory, clk_answer *given) {
    int32_t words[] = {ECHO, 0};
    int32_t length = (int32_t)sizeof words + (int32_t)(random_next() % ((uint64_t)1 << (1 + random_next() % 18)));
    CHECK_OK(clk_slot_grow(slot, length, 0, memory));
    int32_t offset = (int32_t)(random_next() % (uint64_t)(memory->capacity - length + 1));
    uint8_t *bytes = memory->address + offset;
    memcpy(bytes, words, sizeof words);
    for (int32_t i = sizeof words; i < length; i++) bytes[i] = (uint8_t)random_next();
    CHECK_OK(clk_step(session, slot, offset, length, 60000, given));
    CHECK(given->length == length - (int32_t)sizeof words && given->offset + given->length <= given->capacity);
    CHECK(memcmp(given->address + given->offset, bytes + sizeof words, (size_t)given->length) == 0);
}

void echo_of_random_data(void) {
    clk_session session;
    clk_slot slot;
    clk_memory memory = {.size = sizeof memory};
    start_plain();
    CHECK_OK(open_session(&session));
    CHECK_OK(clk_slot_acquire(1, &slot, &memory));
    for (int i = 0; i < 3000; i++) check_echo(session, slot, &memory, &answer);
    CHECK(stats().steps == 3000);
    CHECK_OK(clk_session_close(session, 60000));
}

void answers_grow(void) {
    clk_session session;
    start_plain();
    CHECK_OK(open_session(&session));
    for (int32_t size = 1; size <= 1 << 24; size *= 16) {
        CHECK_OK(step(session, GROW, size, 60000));
        CHECK(answer.length == size && answer.offset == 0 && answer.capacity >= size);
        for (int32_t i = 0; i < size; i++) CHECK(answer.address[i] == (uint8_t)i);
    }
    int32_t grown = answer.capacity;
    CHECK_OK(step(session, EMPTY, 0, 60000));
    CHECK(answer.capacity == grown && answer.length == 0); /* the session keeps the larger block */
    CHECK_OK(clk_session_close(session, 60000));
    CHECK(stats().slots == 1);
}

void one_wrapper_for_each_memory(void) {
    clk_session session;
    start_plain();
    CHECK_OK(open_session(&session));
    CHECK(stats().wrapped == 2);
    for (int i = 0; i < 1000; i++) CHECK_OK(step(session, EMPTY, 0, 60000));
    CHECK(stats().wrapped == 2 && stats().steps == 1000);
    /* When a large slot is released, the pool returns its memory to the system. The next call deletes the wrapper. */
    clk_slot large;
    clk_memory memory = {.size = sizeof memory};
    for (int i = 0; i < 3; i++) {
        CHECK_OK(clk_slot_acquire(1 << 27, &large, &memory));
        memset(memory.address, 0, 8);
        CHECK_OK(clk_step(session, large, 0, 8, 60000, &answer));
        CHECK_OK(clk_slot_release(large));
        CHECK_OK(step(session, EMPTY, 0, 60000));
    }
    /* In a separate process, a shared block keeps its address and wrapper. Only Linux returns shared memory to the system. */
    CHECK(stats().wrapped == (placement == CLK_OWN_PROCESS ? 3 : 5));
    CHECK(stats().slot_bytes < 1 << 27 || (placement == CLK_OWN_PROCESS && strcmp(PRIM_SYSTEM, "Linux") != 0));
}

/* ---- Control --------------------------------------------------------------------------------------------------------- */

static int32_t control(enum command command, int32_t argument) {
    int32_t words[] = {(int32_t)command, argument, 0x12345678};
    memcpy(request_memory.address, words, sizeof words);
    return clk_control(request, 0, sizeof words, 60000, &answer);
}

void control_needs_no_session(void) {
    clk_session session;
    start_plain();
    CHECK_OK(control(ECHO, 0));
    CHECK(answer.length == 4 && memcmp(answer.address + answer.offset, "\x78\x56\x34\x12", 4) == 0);
    CHECK_OK(open_session(&session));
    CHECK_OK(control(GROW, 1 << 20));
    CHECK(answer.length == 1 << 20);
    CHECK_OK(step(session, EMPTY, 0, 60000));
    CHECK(stats().steps == 1 && stats().sessions == 1);
    CHECK_OK(clk_session_close(session, 60000));
    CHECK_OK(control(EMPTY, 0));
    CHECK_OK(clk_jvm_stop(60000));
    CHECK_CODE(CLK_JVM_NOT_RUNNING, NULL, control(EMPTY, 0));
}

void control_errors(void) {
    start_plain();
    CHECK_CODE(CLK_ARGUMENT, "answer is NULL", clk_control(request, 0, 8, 1000, NULL));
    CHECK_CODE(CLK_ARGUMENT, "limit_ms", clk_control(request, 0, 8, 0, &answer));
    CHECK_CODE(CLK_JAVA, "Host.control threw java.lang.IllegalStateException", control(THROW, 0));
    CHECK_CODE(CLK_FRAME, "says no", control(FAIL, CLK_FRAME));
    CHECK_OK(control(EMPTY, 0));
}

/* ---- Sessions -------------------------------------------------------------------------------------------------------- */

void session_handles(void) {
    clk_session first, second;
    start_plain();
    CHECK_OK(open_session(&first));
    CHECK_CODE(CLK_HANDLE, "session 0x0", step(0, EMPTY, 0, 1000));
    CHECK_CODE(CLK_HANDLE, NULL, step(first + 1, EMPTY, 0, 1000));
    CHECK_CODE(CLK_HANDLE, NULL, step(first + ((uint64_t)1 << 32), EMPTY, 0, 1000));
    CHECK_CODE(CLK_HANDLE, NULL, clk_session_close(UINT64_MAX, 1000));
    CHECK_CODE(CLK_HANDLE, "slot 0x0", clk_step(first, 0, 0, 8, 1000, &answer));
    CHECK_OK(clk_session_close(first, 1000));
    CHECK_CODE(CLK_HANDLE, "already closed", clk_session_close(first, 1000));
    CHECK_CODE(CLK_HANDLE, "already closed", step(first, EMPTY, 0, 1000));
    CHECK_OK(open_session(&second));
    CHECK(second != first);
    CHECK_CODE(CLK_HANDLE, NULL, step(first, EMPTY, 0, 1000));
    CHECK_OK(step(second, EMPTY, 0, 1000));
    CHECK(stats().steps == 1 && stats().sessions == 1);
}

void many_sessions_one_after_the_other(void) {
    start_plain();
    for (int i = 0; i < 3000; i++) {
        clk_session session;
        CHECK_OK(open_session(&session));
        CHECK_OK(step(session, EMPTY, 0, 60000));
        CHECK_OK(clk_session_close(session, 60000));
    }
    CHECK(stats().sessions == 0 && stats().slots == 1 && stats().wrapped == 2 && stats().signal_repairs == 0);
}

void too_many_sessions(void) {
    clk_session sessions[256], another;
    start_plain();
    for (int i = 0; i < 256; i++) CHECK_OK(open_session(&sessions[i]));
    CHECK_CODE(CLK_MEMORY, "close one", open_session(&another));
    CHECK_OK(clk_session_close(sessions[100], 60000));
    CHECK_OK(open_session(&another));
    CHECK_OK(step(another, EMPTY, 0, 60000));
}

void call_arguments(void) {
    clk_session session;
    start_plain();
    CHECK_CODE(CLK_ARGUMENT, "session is NULL", clk_session_open(request, 0, 8, 1000, NULL, &answer));
    CHECK_OK(open_session(&session));
    CHECK_CODE(CLK_ARGUMENT, "answer is NULL", clk_step(session, request, 0, 8, 1000, NULL));
    CHECK_CODE(CLK_ARGUMENT, "answer->size", clk_step(session, request, 0, 8, 1000, &(clk_answer){.size = 4}));
    CHECK_CODE(CLK_ARGUMENT, "limit_ms is 0", clk_step(session, request, 0, 8, 0, &answer));
    CHECK_CODE(CLK_ARGUMENT, "negative", clk_step(session, request, -1, 8, 1000, &answer));
    CHECK_CODE(CLK_ARGUMENT, "negative", clk_step(session, request, 0, -8, 1000, &answer));
    CHECK_CODE(CLK_ARGUMENT, "outside", clk_step(session, request, 0, request_memory.capacity + 1, 1000, &answer));
    CHECK_CODE(CLK_ARGUMENT, "outside", clk_step(session, request, INT32_MAX, INT32_MAX, 1000, &answer));
    CHECK_CODE(CLK_ARGUMENT, "limit_ms is -1", clk_session_close(session, -1));
    CHECK_CODE(CLK_ARGUMENT, "limit_ms is 0", clk_jvm_stop(0));
    CHECK(stats().steps == 0);
    CHECK_OK(step(session, EMPTY, 0, 1000));
    CHECK_OK(clk_step(session, request, 0, 8, INT32_MAX, &answer));
}

/* ---- Errors of the host ---------------------------------------------------------------------------------------------- */

void host_errors(void) {
    clk_session session, refused;
    start_plain();
    CHECK_OK(open_session(&session));
    CHECK_CODE(CLK_FRAME, "the host says no: \xC3\xA4\xE2\x82\xAC\xF0\x9F\x9A\x80", step(session, FAIL, CLK_FRAME, 1000));
    CHECK_CODE(CLK_SCHEMA, "different schemas", step(session, FAIL_SILENTLY, CLK_SCHEMA, 1000));
    CHECK_CODE(CLK_HOST, "-4", step(session, FAIL, CLK_TIMEOUT, 1000)); /* the host must not return this code of the shim */
    CHECK_CODE(CLK_HOST, "-2", step(session, FAIL, CLK_MEMORY, 1000));
    CHECK_CODE(CLK_HOST, "-99", step(session, FAIL, -99, 1000));
    CHECK_CODE(CLK_HOST, "-2147483648", step(session, FAIL, INT32_MIN, 1000));
    CHECK_CODE(CLK_JAVA, "IllegalStateException", step(session, GROW_FOREIGN, 0, 1000));
    CHECK_CODE(CLK_JAVA, "OutOfMemoryError", step(session, GROW_TOO_LARGE, 0, 1000));
    CHECK_OK(step(session, EMPTY, 0, 1000));

    int32_t words[] = {FAIL, CLK_PROGRAM};
    memcpy(request_memory.address, words, sizeof words);
    CHECK_CODE(CLK_PROGRAM, "the host says no", clk_session_open(request, 0, 8, 1000, &refused, &answer));
    CHECK(stats().sessions == 1 && stats().slots == 2);
}

/* A round that does not end may still read its request frame, so the pool must not reuse that memory. */
void failed_session_keeps_its_memory(void) {
    clk_session session;
    start_plain();
    CHECK_OK(open_session(&session));
    const uint8_t *read_for_ever = request_memory.address;
    int32_t capacity = request_memory.capacity;
    CHECK_CODE(CLK_SESSION_FAILED, NULL, step(session, FAIL, CLK_SESSION_FAILED, 1000));
    CHECK_CODE(CLK_ARGUMENT, "in use", clk_slot_grow(request, capacity * 2, 0, &request_memory));
    CHECK_OK(clk_session_close(session, 1000));
    CHECK_OK(clk_slot_release(request));
    for (int i = 0; i < 100; i++) {
        CHECK_OK(clk_slot_acquire(capacity, &request, &request_memory));
        CHECK(request_memory.address != read_for_ever);
    }
}

void exceptions(void) {
    clk_session session;
    start_plain();
    CHECK_OK(open_session(&session));
    for (int i = 0; i < 1000; i++) {
        CHECK_CODE(CLK_JAVA, NULL, step(session, THROW, 0, 1000));
        CHECK_OK(step(session, EMPTY, 0, 1000));
    }
    CHECK_CODE(CLK_JAVA, "java.lang.IllegalStateException: thrown in the host: \xC3\xA4\xE2\x82\xAC\xF0\x9F\x9A\x80",
               step(session, THROW, 0, 1000));
}

void stack_overflow(void) {
    clk_session session;
    start_plain();
    CHECK_OK(open_session(&session));
    for (int i = 0; i < 20; i++) CHECK_CODE(CLK_JAVA, "StackOverflowError", step(session, OVERFLOW, 0, 60000));
    CHECK_OK(step(session, EMPTY, 0, 1000));
}

void heap_exhausted(void) {
    clk_session session;
    start_plain();
    CHECK_OK(open_session(&session));
    for (int i = 0; i < 3; i++) CHECK_CODE(CLK_JAVA, "OutOfMemoryError", step(session, EXHAUST, 0, 60000));
    CHECK_OK(step(session, EMPTY, 0, 60000));
    CHECK(clk_jvm_state() == CLK_STATE_RUNNING);
}

void exit_is_refused(void) {
    clk_session session;
    start_plain();
    CHECK_OK(open_session(&session));
    for (int i = 0; i < 3; i++) {
        enum command commands[] = {EXIT, HALT, EXIT_ELSEWHERE};
        CHECK_OK(step(session, commands[i], 0, 60000));
        CHECK(answer.length == 1 && answer.address[0] == 1);
    }
    CHECK_OK(clk_session_close(session, 60000));
    CHECK_OK(clk_jvm_stop(60000));
}

void answer_outside_of_slot(void) {
    clk_session session;
    start_plain();
    CHECK_OK(open_session(&session));
    CHECK_CODE(CLK_HOST, "65536 + 1", step(session, OUTSIDE, 0, 1000));
    CHECK_OK(step(session, EMPTY, 0, 1000));
}

/* ---- Several callers ------------------------------------------------------------------------------------------------- */

static clk_session shared_session;

struct sleeper {
    pthread_t thread;
    int32_t ms;
    int32_t result;
};

static void *sleep_in_host(void *argument) {
    struct sleeper *sleeper = argument;
    clk_answer own = {.size = sizeof own};
    int32_t words[] = {SLEEP, sleeper->ms};
    memcpy(request_memory.address, words, sizeof words);
    sleeper->result = clk_step(shared_session, request, 0, 8, 60000, &own);
    return NULL;
}

static void begin_sleep(struct sleeper *sleeper, int32_t ms) {
    sleeper->ms = ms;
    uint64_t before = stats().steps;
    CHECK(pthread_create(&sleeper->thread, NULL, sleep_in_host, sleeper) == 0);
    while (stats().steps == before) sleep_ms(1);
}

static void end_sleep(struct sleeper *sleeper) {
    CHECK(pthread_join(sleeper->thread, NULL) == 0);
    CHECK(sleeper->result == CLK_OK);
}

void released_request_stays_valid(void) {
    struct sleeper sleeper;
    clk_slot other;
    clk_memory memory = {.size = sizeof memory};
    start_plain();
    CHECK_OK(open_session(&shared_session));
    begin_sleep(&sleeper, 1500);
    CHECK_CODE(CLK_ARGUMENT, "in use by a running call", clk_slot_grow(request, 1 << 21, 0, &memory));
    CHECK_OK(clk_slot_release(request));
    CHECK_CODE(CLK_HANDLE, NULL, clk_slot_release(request));
    CHECK_OK(clk_slot_acquire(1 << 20, &other, &memory));
    CHECK(memory.address != request_memory.address);
    end_sleep(&sleeper);
    CHECK_OK(clk_slot_acquire(1 << 20, &other, &memory));
    CHECK(memory.address == request_memory.address);
}

static void *echo_thread(void *seed) {
    clk_session session;
    clk_slot slot;
    clk_memory memory = {.size = sizeof memory};
    clk_answer own = {.size = sizeof own};
    random_seed((uint64_t)(uintptr_t)seed);
    CHECK_OK(clk_slot_acquire(8, &slot, &memory));
    memset(memory.address, 0, 8);
    CHECK_OK(clk_session_open(slot, 0, 8, 60000, &session, &own));
    for (int i = 0; i < 500; i++) check_echo(session, slot, &memory, &own);
    CHECK_OK(clk_session_close(session, 60000));
    CHECK_OK(clk_slot_release(slot));
    return NULL;
}

void callers_take_turns(void) {
    pthread_t threads[4];
    start_plain();
    for (uintptr_t i = 0; i < 4; i++) CHECK(pthread_create(&threads[i], NULL, echo_thread, (void *)(i + 1)) == 0);
    for (int i = 0; i < 4; i++) CHECK(pthread_join(threads[i], NULL) == 0);
    CHECK(stats().steps == 2000 && stats().sessions == 0 && stats().slots == 1);
}

void own_turn_times_out(void) {
    struct sleeper sleeper;
    clk_session session;
    start_plain();
    CHECK_OK(open_session(&shared_session));
    begin_sleep(&sleeper, 3000);
    int64_t begin = now_ns();
    CHECK_CODE(CLK_TIMEOUT, "did not execute this one", clk_session_open(request, 0, 8, 200, &session, &answer));
    CHECK(now_ns() - begin >= 200000000 && now_ns() - begin < 2500000000);
    end_sleep(&sleeper);
    CHECK_OK(open_session(&session));
    CHECK(stats().steps == 1 && clk_jvm_state() == CLK_STATE_RUNNING);
}

/* ---- Logs ------------------------------------------------------------------------------------------------------------ */

void logs_are_bounded(void) {
    enum { LINES = 50000 };
    clk_session session;
    char line[100], expected[100];
    int32_t level, read = 0;
    start_plain();
    CHECK_OK(open_session(&session));
    while (clk_log_read(&level, line, sizeof line) >= 0) {
    }
    CHECK_OK(step(session, LOG, LINES, 60000));
    while (clk_log_read(&level, line, sizeof line) >= 0) {
        snprintf(expected, sizeof expected, "line %d", read);
        CHECK(strcmp(line, expected) == 0 && level == read % 4);
        read++;
    }
    CHECK(read > 1000 && read < LINES && stats().logs_dropped == (uint64_t)(LINES - read));
    for (int round = 0; round < 50; round++) { /* enough rounds to fill the ring several times */
        CHECK_OK(step(session, LOG, 500, 60000));
        for (read = 0; clk_log_read(&level, line, 8) >= 0; read++) CHECK(strlen(line) <= 7);
        CHECK(read == 500);
    }
}
