/* A semaphore on a futex. glibc's only wait on the monotonic clock, sem_clockwait, needs glibc 2.30. */
#define _GNU_SOURCE /* syscall */
#include <linux/futex.h>
#include <stdatomic.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
#include "prim.h"

#define NANOS_PER_SECOND INT64_C(1000000000)

void prim_semaphore_init(prim_semaphore *semaphore, unsigned count) {
    atomic_init(&semaphore->count, count);
    atomic_init(&semaphore->waiting, 0);
    semaphore->scope = FUTEX_PRIVATE_FLAG;
}

void prim_semaphore_share(prim_semaphore *semaphore) {
    prim_semaphore_init(semaphore, 0);
    semaphore->scope = 0;
}

void prim_semaphore_post(prim_semaphore *semaphore) {
    atomic_fetch_add(&semaphore->count, 1);
    if (atomic_load(&semaphore->waiting) != 0) syscall(SYS_futex, &semaphore->count, FUTEX_WAKE | semaphore->scope, 1, NULL, NULL, 0);
}

bool prim_semaphore_try(prim_semaphore *semaphore) {
    uint32_t count = atomic_load(&semaphore->count);
    while (count != 0) {
        if (atomic_compare_exchange_weak(&semaphore->count, &count, count - 1)) return true;
    }
    return false;
}

/* The system call returns at once when the count is no longer 0, so no post is missed. Its time is absolute and monotonic. */
bool prim_semaphore_sleep_until(prim_semaphore *semaphore, int64_t deadline) {
    struct timespec until = {.tv_sec = (time_t)(deadline / NANOS_PER_SECOND), .tv_nsec = (long)(deadline % NANOS_PER_SECOND)};
    struct timespec *limit = deadline == INT64_MAX ? NULL : &until;
    bool taken;
    atomic_fetch_add(&semaphore->waiting, 1);
    while (!(taken = prim_semaphore_try(semaphore)) && prim_now() < deadline) {
        syscall(SYS_futex, &semaphore->count, FUTEX_WAIT_BITSET | semaphore->scope, 0, limit, NULL, FUTEX_BITSET_MATCH_ANY);
    }
    atomic_fetch_sub(&semaphore->waiting, 1);
    return taken;
}
