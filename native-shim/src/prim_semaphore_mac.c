/* A semaphore of libdispatch: macOS has no unnamed POSIX semaphores, and no timed waits on named ones. */
#include <dispatch/dispatch.h>
#include "prim.h"

void prim_semaphore_init(prim_semaphore *semaphore, unsigned count) { *semaphore = dispatch_semaphore_create((intptr_t)count); }

void prim_semaphore_post(prim_semaphore *semaphore) { dispatch_semaphore_signal(*semaphore); }

bool prim_semaphore_try(prim_semaphore *semaphore) { return dispatch_semaphore_wait(*semaphore, DISPATCH_TIME_NOW) == 0; }

bool prim_semaphore_sleep_until(prim_semaphore *semaphore, int64_t deadline) {
    int64_t left = deadline - prim_now();
    dispatch_time_t until = deadline == INT64_MAX ? DISPATCH_TIME_FOREVER : dispatch_time(DISPATCH_TIME_NOW, left > 0 ? left : 0);
    return dispatch_semaphore_wait(*semaphore, until) == 0;
}
