#include "prim.h"

#define SPIN_NANOS INT64_C(500000)

/* Spins for a short time, because waking an idle core of a virtual machine takes longer than a small tick. Yields to other threads meanwhile. */
static bool spin(prim_semaphore *semaphore, int64_t deadline) {
    int64_t end = prim_now() + SPIN_NANOS < deadline ? prim_now() + SPIN_NANOS : deadline;
    while (!prim_semaphore_try(semaphore)) {
        if (prim_now() >= end) return false;
        prim_yield();
    }
    return true;
}

bool prim_semaphore_wait_until(prim_semaphore *semaphore, int64_t deadline) {
    return spin(semaphore, deadline) || prim_semaphore_sleep_until(semaphore, deadline);
}

void prim_semaphore_wait(prim_semaphore *semaphore) { prim_semaphore_wait_until(semaphore, INT64_MAX); }
