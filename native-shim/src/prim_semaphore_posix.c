/* A semaphore for threads of any process, based on a futex, which macOS calls ulock. POSIX semaphores are not used because macOS lacks unnamed ones, and
 * because only sem_clockwait, which needs glibc 2.30, waits on the monotonic clock. */
#define _GNU_SOURCE /* syscall */
#include <stdatomic.h>
#include "prim.h"

#if defined(__APPLE__)
/* These functions are private, but the locks of macOS use them too. The public os_sync_wait_on_address needs macOS 14.4. */
int __ulock_wait(uint32_t operation, void *address, uint64_t value, uint32_t timeout_us);
int __ulock_wake(uint32_t operation, void *address, uint64_t value);
#define COMPARE_AND_WAIT_SHARED 3
#define LONGEST_WAIT_NANOS INT64_C(1000000000)

static void wake(prim_semaphore *semaphore) { __ulock_wake(COMPARE_AND_WAIT_SHARED, &semaphore->count, 0); }

static void sleep_while_zero(prim_semaphore *semaphore, int64_t deadline) {
    int64_t left = deadline - prim_now();
    if (left <= 0) return; /* for __ulock_wait, 0 means no limit */
    int64_t wait = left < LONGEST_WAIT_NANOS ? left : LONGEST_WAIT_NANOS;
    __ulock_wait(COMPARE_AND_WAIT_SHARED, &semaphore->count, 0, (uint32_t)(wait / 1000 + 1));
}
#else
#include <linux/futex.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#define NANOS_PER_SECOND INT64_C(1000000000)

static void wake(prim_semaphore *semaphore) { syscall(SYS_futex, &semaphore->count, FUTEX_WAKE, 1, NULL, NULL, 0); }

static void sleep_while_zero(prim_semaphore *semaphore, int64_t deadline) {
    struct timespec until = {.tv_sec = (time_t)(deadline / NANOS_PER_SECOND), .tv_nsec = (long)(deadline % NANOS_PER_SECOND)};
    struct timespec *limit = deadline == INT64_MAX ? NULL : &until;
    syscall(SYS_futex, &semaphore->count, FUTEX_WAIT_BITSET, 0, limit, NULL, FUTEX_BITSET_MATCH_ANY);
}
#endif

void prim_semaphore_init(prim_semaphore *semaphore, unsigned count) {
    atomic_init(&semaphore->count, count);
    atomic_init(&semaphore->waiting, 0);
}

void prim_semaphore_share(prim_semaphore *semaphore) { prim_semaphore_init(semaphore, 0); }

void prim_semaphore_post(prim_semaphore *semaphore) {
    atomic_fetch_add(&semaphore->count, 1);
    if (atomic_load(&semaphore->waiting) != 0) wake(semaphore);
}

bool prim_semaphore_try(prim_semaphore *semaphore) {
    uint32_t count = atomic_load(&semaphore->count);
    while (count != 0) {
        if (atomic_compare_exchange_weak(&semaphore->count, &count, count - 1)) return true;
    }
    return false;
}

/* If another thread posts before this thread sleeps, the system call returns at once, because the count is no longer 0. So no post is missed. */
bool prim_semaphore_sleep_until(prim_semaphore *semaphore, int64_t deadline) {
    bool taken;
    atomic_fetch_add(&semaphore->waiting, 1);
    while (!(taken = prim_semaphore_try(semaphore)) && prim_now() < deadline) sleep_while_zero(semaphore, deadline);
    atomic_fetch_sub(&semaphore->waiting, 1);
    return taken;
}
