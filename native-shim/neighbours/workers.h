/* Threads that run one function together with the caller. */
#ifndef NEIGHBOURS_WORKERS_H
#define NEIGHBOURS_WORKERS_H

#include <stdint.h>

enum { MAX_WORKERS = 16 };

struct workers;

/* Returns NULL without memory. */
struct workers *workers_create(void);
void workers_destroy(struct workers *workers);

/*
 * Calls `work(context, 0)` here, and `work(context, number)` with other numbers on up to `threads` - 1 other threads. Returns when all calls have
 * returned. A thread that wakes up after the first call has returned does nothing, so the calls must take their parts of the work from a counter.
 * Missing threads are started; if the system refuses one, fewer threads work.
 */
void workers_run(struct workers *workers, int32_t threads, void (*work)(void *context, int32_t number), void *context);

#endif
