/* Makes random calls in random order, with valid, stale and random handles, offsets and sizes. The seed determines the sequence. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "test.h"

#define HANDLES 8
#define CALLS 300
#define LIMIT_MS 60000

/* Seeds that calls_in_any_order repeats. Add each seed that has found an error. */
static const uint64_t corpus[] = {1, 2, 3};

/* The commands of the test host after which the session continues. */
static const enum command commands[] = {EMPTY, ECHO,    GROW,         THROW,          FAIL,         FAIL_SILENTLY,
                                        LOG,   OUTSIDE, GROW_FOREIGN, GROW_TOO_LARGE, IMPLICIT_NULL};

static clk_slot slots[HANDLES];
static clk_memory memories[HANDLES];
static clk_session sessions[HANDLES];

static int below(int count) { return (int)(random_next() % (uint64_t)count); }

/* Returns a handle of the table or, in one of eight calls, a random number. */
static uint64_t any_handle(const uint64_t *table) { return below(8) == 0 ? random_next() : table[below(HANDLES)]; }

static int32_t any_number(int32_t usual) {
    static const int32_t odd[] = {0, -1, 1, INT32_MAX, INT32_MIN, 1 << 30, (1 << 30) + 1};
    return below(8) == 0 ? odd[below(7)] : below(usual);
}

/* Writes a random command to the memory of a slot. */
static void write_command(int place) {
    enum command command = commands[below((int)(sizeof commands / sizeof commands[0]))];
    /* The log must have room for all lines, so their number is limited. */
    int32_t words[] = {(int32_t)command, command == LOG ? below(100) : any_number(100000)};
    if (memories[place].address != NULL && memories[place].capacity >= (int32_t)sizeof words) {
        memcpy(memories[place].address, words, sizeof words);
    }
}

static void check_answer(int32_t code, const clk_answer *given) {
    CHECK(code == CLK_OK || strcmp(clk_error_name(code), "CLK_UNKNOWN") != 0);
    if (code != CLK_OK) return;
    CHECK(given->offset >= 0 && given->length >= 0 && given->offset <= given->capacity - given->length);
    volatile uint8_t sum = 0;
    for (int32_t i = 0; i < given->length; i++) sum = (uint8_t)(sum + given->address[given->offset + i]);
}

static void release(int place) {
    int32_t code = clk_slot_release(slots[place]);
    CHECK(code == CLK_OK || code == CLK_HANDLE);
    memories[place].address = NULL;
}

static void acquire(int place) {
    /* Each place has only one slot, so an earlier one would leak. */
    if (memories[place].address != NULL) release(place);
    clk_memory memory = {.size = sizeof memory};
    clk_slot slot;
    int32_t capacity = any_number(100000);
    if (clk_slot_acquire(capacity, &slot, &memory) != CLK_OK) return;
    CHECK(memory.capacity >= capacity);
    slots[place] = slot;
    memories[place] = memory;
}

static void grow(int place) {
    clk_memory memory = {.size = sizeof memory};
    if (clk_slot_grow(any_handle(slots), any_number(200000), any_number(1000), &memory) == CLK_OK) {
        for (int i = 0; i < HANDLES; i++) {
            /* Requesting 1 byte returns the current address, which has changed for the slot that grew. */
            clk_memory same = {.size = sizeof same};
            if (memories[i].address != NULL && clk_slot_grow(slots[i], 1, 0, &same) == CLK_OK) memories[i] = same;
        }
    }
    (void)place;
}

static void open(int place) {
    clk_session session;
    clk_answer given = {.size = sizeof given};
    int slot = below(HANDLES);
    clk_session_close(sessions[place], LIMIT_MS);
    write_command(slot);
    int32_t code = clk_session_open(slots[slot], below(4) == 0 ? any_number(1000) : 0, below(4) == 0 ? any_number(1000) : 8, LIMIT_MS,
                                    &session, &given);
    check_answer(code, &given);
    if (code == CLK_OK) sessions[place] = session;
}

static void call(int place) {
    clk_answer given = {.size = sizeof given};
    write_command(place);
    int32_t offset = below(4) == 0 ? any_number(1000) : 0;
    int32_t length = below(4) == 0 ? any_number(1000) : 8;
    int32_t code = below(6) == 0
                       ? clk_control(slots[place], offset, length, LIMIT_MS, &given)
                       : clk_step(any_handle(sessions), below(8) == 0 ? any_handle(slots) : slots[place], offset, length, LIMIT_MS, &given);
    check_answer(code, &given);
}

static void query(void) {
    char text[64];
    int32_t level;
    int32_t capacity = below((int)sizeof text + 1);
    clk_last_error(text, capacity);
    clk_jvm_description(text, capacity);
    clk_log_read(&level, below(2) == 0 ? text : NULL, capacity);
    CHECK(clk_error_name(any_number(40)) != NULL);
    CHECK(clk_jvm_state() == CLK_STATE_RUNNING);
}

static void run_sequence(uint64_t seed) {
    random_seed(seed);
    clk_stats before = stats();
    for (int i = 0; i < CALLS; i++) {
        int place = below(HANDLES);
        switch (below(8)) {
            case 0: acquire(place); break;
            case 1: grow(place); break;
            case 2: release(place); break;
            case 3: open(place); break;
            case 4: clk_session_close(any_handle(sessions), LIMIT_MS); break;
            case 5: query(); break;
            default: call(place); break;
        }
    }
    for (int i = 0; i < HANDLES; i++) {
        clk_session_close(sessions[i], LIMIT_MS);
        CHECK(clk_session_close(sessions[i], LIMIT_MS) == CLK_HANDLE);
        release(i);
        CHECK(clk_slot_release(slots[i]) == CLK_HANDLE);
    }
    clk_stats after = stats();
    CHECK(after.sessions == before.sessions && after.sessions == 0);
    CHECK(clk_jvm_state() == CLK_STATE_RUNNING);
}

static void warm_up(void) {
    clk_session session;
    start_plain();
    CHECK_OK(open_session(&session));
    CHECK_OK(clk_session_close(session, LIMIT_MS));
}

void calls_in_any_order(void) {
    warm_up();
    for (size_t i = 0; i < sizeof corpus / sizeof corpus[0]; i++) run_sequence(corpus[i]);
    clk_stats settled = stats();
    for (size_t i = 0; i < sizeof corpus / sizeof corpus[0]; i++) run_sequence(corpus[i]);
    CHECK(stats().slots == settled.slots);
}

void fuzz(void) {
    const char *seconds = getenv("CLK_FUZZ_SECONDS");
    const char *seed = getenv("CLK_FUZZ_SEED");
    int64_t end = now_ns() + (int64_t)(seconds != NULL ? atoi(seconds) : 10) * 1000000000;
    uint64_t first = seed != NULL ? strtoull(seed, NULL, 10) : (uint64_t)now_ns();
    uint64_t count = 0;
    warm_up();
    for (; now_ns() < end; count++) {
        /* The seed is printed in advance, so it is in the output even after a crash. */
        printf("\rseed %llu", (unsigned long long)(first + count));
        fflush(stdout);
        run_sequence(first + count);
    }
    printf("\nDone %llu runs of %d calls, 0 findings\n", (unsigned long long)count, CALLS);
}
