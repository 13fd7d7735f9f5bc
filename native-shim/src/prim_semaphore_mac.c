/* A semaphore of libdispatch: macOS has no unnamed POSIX semaphores, and no timed waits on named ones. In shared memory, a count with ulock. */
#include <dispatch/dispatch.h>
#include <stdatomic.h>
#include "prim.h"

/* The system's own locks use these functions; the public os_sync_wait_on_address needs macOS 14.4. */
int __ulock_wait(uint32_t operation, void *address, uint64_t value, uint32_t timeout_us);
int __ulock_wake(uint32_t operation, void *address, uint64_t value);
#define COMPARE_AND_WAIT_SHARED 3
#define LONGEST_WAIT_NANOS INT64_C(1000000000)

void prim_semaphore_init(prim_semaphore *semaphore, unsigned count) { semaphore->own = dispatch_semaphore_create((intptr_t)count); }

void prim_semaphore_share(prim_semaphore *semaphore) {
    atomic_init(&semaphore->count, 0);
    atomic_init(&semaphore->waiting, 0);
}

void prim_semaphore_post(prim_semaphore *semaphore) {
    if (semaphore->own != NULL) {
        dispatch_semaphore_signal(semaphore->own);
        return;
    }
    atomic_fetch_add(&semaphore->count, 1);
    if (atomic_load(&semaphore->waiting) != 0) __ulock_wake(COMPARE_AND_WAIT_SHARED, &semaphore->count, 0);
}

bool prim_semaphore_try(prim_semaphore *semaphore) {
    if (semaphore->own != NULL) return dispatch_semaphore_wait(semaphore->own, DISPATCH_TIME_NOW) == 0;
    uint32_t count = atomic_load(&semaphore->count);
    while (count != 0) {
        if (atomic_compare_exchange_weak(&semaphore->count, &count, count - 1)) return true;
    }
    return false;
}

static bool sleep_shared(prim_semaphore *semaphore, int64_t deadline) {
    bool taken;
    atomic_fetch_add(&semaphore->waiting, 1);
    for (;;) {
        int64_t left = deadline - prim_now();
        if ((taken = prim_semaphore_try(semaphore)) || left <= 0) break;
        int64_t wait = left < LONGEST_WAIT_NANOS ? left : LONGEST_WAIT_NANOS;
        __ulock_wait(COMPARE_AND_WAIT_SHARED, &semaphore->count, 0, (uint32_t)(wait / 1000 + 1)); /* 0 would mean no limit */
    }
    atomic_fetch_sub(&semaphore->waiting, 1);
    return taken;
}

bool prim_semaphore_sleep_until(prim_semaphore *semaphore, int64_t deadline) {
    if (semaphore->own == NULL) return sleep_shared(semaphore, deadline);
    int64_t left = deadline - prim_now();
    dispatch_time_t until = deadline == INT64_MAX ? DISPATCH_TIME_FOREVER : dispatch_time(DISPATCH_TIME_NOW, left > 0 ? left : 0);
    return dispatch_semaphore_wait(semaphore->own, until) == 0;
}
