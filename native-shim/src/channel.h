/*
 * The beginning of the memory that the process of the caller (the parent) shares with the JVM's own process (the child). Any number of blocks
 * of slots follow. One side at a time owns all fields except `state` and `log`: the child from `request` to `done`, otherwise the parent.
 *
 *   parent: fills in `call`                   posts `request`, waits for `done`
 *   child:  runs it, fills in the result      posts `done`, waits for `request`
 *           needs a larger answer: CHANNEL_GROW, after which the parent fills in call.answer and posts `request`
 *
 * The first `done` of a child reports its start. The parent also posts `done` when the child has ended.
 */
#ifndef COLLEKTIVE_CHANNEL_H
#define COLLEKTIVE_CHANNEL_H

#include "error.h"
#include "host.h"
#include "log.h"
#include "prim.h"

/* Instead of a result. */
#define CHANNEL_GROW 1
#define CHANNEL_SILENT 2 /* before the child's first answer */

#define CHANNEL_ALIGNMENT 4096

struct channel {
    uint32_t version; /* CLK_VERSION; checked by the child, with the size */
    uint32_t size;
    prim_semaphore request, done;
    struct host_call call;                    /* its pointers are valid only in the process that set them; HOST_STOP uses only limit_ms */
    struct block request_block, answer_block; /* copies of its blocks, of which only `offset` and `capacity` count */
    int32_t result;                           /* CLK_OK, an error with its text, or one of the values above */
    int32_t capacity;                         /* of CHANNEL_GROW */
    struct host_state state;                  /* written by the child at any time */
    char text[ERROR_CAPACITY];                /* error, or the version after the start */
    struct log_ring log;                      /* written by the child, read by the parent at any time */
};

#define CHANNEL_BYTES ((sizeof(struct channel) + CHANNEL_ALIGNMENT - 1) / CHANNEL_ALIGNMENT * CHANNEL_ALIGNMENT)

#endif
