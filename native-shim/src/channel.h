/*
 * The beginning of the memory that the caller's process (the parent) shares with the JVM's own process (the child). The blocks of slots follow it.
 *
 * Only one side at a time may access the fields, except `state` and `log`: the child from `request` to `done`, the parent at other times.
 *
 *   parent: fills in `call`, posts `request` and waits for `done`
 *   child:  runs the call, fills in the result, posts `done` and waits for `request`
 *
 * If the child needs a larger block for the answer, its result is CHANNEL_GROW. The parent then fills in `answer_block` and posts `request` again.
 * The first `done` of a child reports its start. The parent itself also posts `done` when the child has ended.
 */
#ifndef COLLEKTIVE_CHANNEL_H
#define COLLEKTIVE_CHANNEL_H

#include "error.h"
#include "host.h"
#include "log.h"
#include "prim.h"

/* Values of `result` that are not results of a call. */
#define CHANNEL_GROW 1
#define CHANNEL_SILENT 2 /* the child has not answered yet */

#define CHANNEL_ALIGNMENT 4096

struct channel {
    uint32_t version; /* CLK_VERSION; the child checks it and the size */
    uint32_t size;
    prim_semaphore request, done;
    struct host_call call;                    /* its pointers are valid only in the process that set them; HOST_STOP uses only limit_ms */
    struct block request_block, answer_block; /* copies of the call's blocks; only `offset` and `capacity` are valid in both processes */
    int32_t result;                           /* CLK_OK, an error with its text, or one of the values above */
    int32_t capacity;                         /* requested by CHANNEL_GROW */
    struct host_state state;                  /* the child may write it at any time */
    char text[ERROR_CAPACITY];                /* text of the error; after the start, the version */
    struct log_ring log;                      /* the child may write it, and the parent may read it, at any time */
};

#define CHANNEL_BYTES ((sizeof(struct channel) + CHANNEL_ALIGNMENT - 1) / CHANNEL_ALIGNMENT * CHANNEL_ALIGNMENT)

#endif
