#include "prim.h"

#define SPIN_NANOS INT64_C(500000)

/* Spins briefly, because waking an idle core of a virtual machine takes longer than a small tick. Yields to other threads. */
static inline bool spin(bool (*try)(void *), void *semaphore, int64_t deadline) {
    int64_t end = prim_now() + SPIN_NANOS < deadline ? prim_now() + SPIN_NANOS : deadline;
    while (!try(semaphore)) {
        if (prim_now() >= end) return false;
        prim_yield();
    }
    return true;
}

static bool try_own(void *semaphore) { return prim_semaphore_try(semaphore); }

static bool try_shared(void *semaphore) { return prim_shared_try(semaphore); }

bool prim_semaphore_wait_until(prim_semaphore *semaphore, int64_t deadline) {
    return spin(try_own, semaphore, deadline) || prim_semaphore_sleep_until(semaphore, deadline);
}

bool prim_shared_wait_until(prim_shared_semaphore *semaphore, int64_t deadline) {
    return spin(try_shared, semaphore, deadline) || prim_shared_sleep_until(semaphore, deadline);
}

void prim_semaphore_wait(prim_semaphore *semaphore) { prim_semaphore_wait_until(semaphore, INT64_MAX); }
