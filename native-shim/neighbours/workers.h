/* Threads that run one function together with the caller. */
#ifndef NEIGHBOURS_WORKERS_H
#define NEIGHBOURS_WORKERS_H

#include <stdint.h>

enum { MAX_WORKERS = 16 };

struct workers;

/* Returns NULL if out of memory. */
struct workers *workers_create(void);
void workers_destroy(struct workers *workers);

/*
 * Calls `work(context, 0)` on this thread, and `work(context, number)` with numbers from 1 on up to `threads` - 1 other threads. Returns when all
 * calls have returned. A thread that wakes up after the first call has returned does nothing. Therefore, the calls must not divide the work by
 * their numbers, but claim parts of it from a counter. Starts threads that are missing. If the system cannot create one, fewer threads work.
 */
void workers_run(struct workers *workers, int32_t threads, void (*work)(void *context, int32_t number), void *context);

#endif
