#include <pthread.h>
#include <stdatomic.h>
#include <stddef.h>
#include <string.h>
#include "test.h"

void slot_arguments(void) {
    clk_slot slot;
    clk_memory memory = {.size = sizeof memory};
    CHECK_CODE(CLK_ARGUMENT, "slot is NULL", clk_slot_acquire(1, NULL, &memory));
    CHECK_CODE(CLK_ARGUMENT, "memory is NULL", clk_slot_acquire(1, &slot, NULL));
    CHECK_CODE(CLK_ARGUMENT, "capacity is 0", clk_slot_acquire(0, &slot, &memory));
    CHECK_CODE(CLK_ARGUMENT, "capacity is -1", clk_slot_acquire(-1, &slot, &memory));
    CHECK_CODE(CLK_ARGUMENT, "capacity is 1073741825", clk_slot_acquire((1 << 30) + 1, &slot, &memory));
    CHECK_OK(clk_slot_acquire(1, &slot, &memory));
    CHECK(memory.capacity >= 1 && (uintptr_t)memory.address % 64 == 0);
    CHECK_CODE(CLK_ARGUMENT, "keep is -1", clk_slot_grow(slot, 10, -1, &memory));
    CHECK_CODE(CLK_ARGUMENT, "keep is", clk_slot_grow(slot, 1 << 20, memory.capacity + 1, &memory));
    CHECK_CODE(CLK_ARGUMENT, "capacity is 0", clk_slot_grow(slot, 0, 0, &memory));
    CHECK_CODE(CLK_ARGUMENT, "memory is NULL", clk_slot_grow(slot, 10, 0, NULL));
}

void slot_handles(void) {
    clk_memory memory = {.size = sizeof memory};
    clk_slot first, second;
    CHECK_CODE(CLK_HANDLE, "slot 0x0", clk_slot_release(0));
    CHECK_CODE(CLK_HANDLE, NULL, clk_slot_release(UINT64_MAX));
    CHECK_OK(clk_slot_acquire(100, &first, &memory));
    CHECK(first != 0);
    CHECK_CODE(CLK_HANDLE, NULL, clk_slot_release(first + ((uint64_t)1 << 32)));
    CHECK_CODE(CLK_HANDLE, NULL, clk_slot_release(first + 1));
    CHECK_OK(clk_slot_release(first));
    CHECK_CODE(CLK_HANDLE, "already released", clk_slot_release(first));
    CHECK_CODE(CLK_HANDLE, NULL, clk_slot_grow(first, 100, 0, &memory));
    CHECK_OK(clk_slot_acquire(100, &second, &memory));
    CHECK(second != first);
    CHECK_CODE(CLK_HANDLE, NULL, clk_slot_release(first));
    CHECK(stats().slots == 1);
}

void slot_growth_keeps_the_tail(void) {
    clk_memory memory = {.size = sizeof memory};
    clk_slot slot;
    CHECK_OK(clk_slot_acquire(4096, &slot, &memory));
    for (int32_t i = 0; i < memory.capacity; i++) memory.address[i] = (uint8_t)(i * 7);
    int32_t before = memory.capacity;
    CHECK_OK(clk_slot_grow(slot, 100000, 1001, &memory));
    CHECK(memory.capacity >= 100000 && (uintptr_t)memory.address % 64 == 0);
    for (int32_t i = 1; i <= 1001; i++) CHECK(memory.address[memory.capacity - i] == (uint8_t)((before - i) * 7));
    const uint8_t *address = memory.address;
    CHECK_OK(clk_slot_grow(slot, 5, 0, &memory));
    CHECK(memory.address == address); /* the slot is already large enough */
}

void slots_are_reused(void) {
    clk_memory memory = {.size = sizeof memory};
    clk_slot slot;
    CHECK_OK(clk_slot_acquire(70000, &slot, &memory));
    const uint8_t *address = memory.address;
    uint64_t bytes = stats().slot_bytes;
    CHECK(bytes == (uint64_t)memory.capacity);
    for (int32_t i = 0; i < 1000; i++) {
        CHECK_OK(clk_slot_release(slot));
        CHECK_OK(clk_slot_acquire(65537 + i, &slot, &memory));
        CHECK(memory.address == address && stats().slot_bytes == bytes);
    }
    /* The pool keeps at most 64 MiB of unused memory, and returns the rest to the system. */
    CHECK_OK(clk_slot_release(slot));
    CHECK_OK(clk_slot_acquire(1 << 27, &slot, &memory));
    CHECK_OK(clk_slot_release(slot));
    CHECK(stats().slot_bytes == bytes && stats().slots == 0);
}

/* ---- Many threads against a model ------------------------------------------------------------------------------------ */

enum { THREADS = 4, HELD = 16, OPERATIONS = 20000 };

struct held {
    clk_slot slot;
    clk_memory memory;
    uint8_t mark; /* value of each byte in the memory */
};

static atomic_int model_slots;

static void check_held(const struct held *held) {
    for (int32_t i = 0; i < held->memory.capacity; i += 1 + held->memory.capacity / 64) CHECK(held->memory.address[i] == held->mark);
    CHECK(held->memory.address[held->memory.capacity - 1] == held->mark);
}

static void mark_held(struct held *held) {
    held->mark = (uint8_t)random_next();
    memset(held->memory.address, held->mark, (size_t)held->memory.capacity);
}

/* Returns a capacity. Small capacities are frequent, and large ones are rare. */
static int32_t random_capacity(void) { return 1 + (int32_t)(random_next() % ((uint64_t)1 << (4 + random_next() % 15))); }

static void operate(struct held *held, clk_slot *stale) {
    if (held->slot == 0) {
        int32_t capacity = random_capacity();
        CHECK_OK(clk_slot_acquire(capacity, &held->slot, &held->memory));
        CHECK(held->memory.capacity >= capacity && held->slot != *stale);
        atomic_fetch_add(&model_slots, 1);
        mark_held(held);
        return;
    }
    check_held(held);
    if (random_next() % 3 == 0) {
        CHECK_OK(clk_slot_release(held->slot));
        atomic_fetch_sub(&model_slots, 1);
        *stale = held->slot;
        held->slot = 0;
        CHECK(clk_slot_release(*stale) == CLK_HANDLE);
    } else if (random_next() % 2 == 0) {
        int32_t keep = (int32_t)(random_next() % (uint64_t)(held->memory.capacity + 1));
        int32_t capacity = random_capacity();
        CHECK_OK(clk_slot_grow(held->slot, capacity, keep, &held->memory));
        CHECK(held->memory.capacity >= capacity);
        for (int32_t i = 1; i <= keep; i += 1 + keep / 64) CHECK(held->memory.address[held->memory.capacity - i] == held->mark);
        mark_held(held);
    } else {
        CHECK(clk_slot_grow(*stale, 1, 0, &(clk_memory){.size = sizeof(clk_memory)}) == CLK_HANDLE);
    }
}

static void *model_thread(void *seed) {
    struct held held[HELD] = {{0}};
    clk_slot stale = 0;
    random_seed((uint64_t)(uintptr_t)seed);
    for (int i = 0; i < HELD; i++) held[i].memory.size = sizeof held[i].memory;
    for (int i = 0; i < OPERATIONS; i++) operate(&held[random_next() % HELD], &stale);
    for (int i = 0; i < HELD; i++) {
        if (held[i].slot != 0) check_held(&held[i]);
    }
    return NULL;
}

void slots_agree_with_a_model(void) {
    pthread_t threads[THREADS];
    for (uintptr_t i = 0; i < THREADS; i++) CHECK(pthread_create(&threads[i], NULL, model_thread, (void *)(i + 1)) == 0);
    for (int i = 0; i < THREADS; i++) CHECK(pthread_join(threads[i], NULL) == 0);
    CHECK(stats().slots == atomic_load(&model_slots));
}
