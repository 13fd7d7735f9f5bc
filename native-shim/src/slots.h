/*
 * The pool of native memory. A slot is a handle that owns one block of memory. When a slot grows, it gets another block. The generation in the handle
 * distinguishes a slot from earlier ones. Any thread may call these functions, unless stated otherwise.
 */
#ifndef COLLEKTIVE_SLOTS_H
#define COLLEKTIVE_SLOTS_H

#include <stdbool.h>
#include <stdint.h>
#include "collektive_shim.h"

struct block {
    uint8_t *address;
    uint64_t offset;     /* position in the memory that the JVM's own process shares; 0 for a block that is not shared */
    int32_t capacity;    /* a power of two */
    int32_t pins;        /* number of calls of the host that use the block now */
    bool counted;        /* the block has memory, which is counted in the pool's size */
    bool abandoned;      /* no slot owns the block, so the last unpin returns it to the pool */
    void *wrapper;       /* global reference to its direct ByteBuffer, or NULL; used by the engine thread only, while pinned */
    struct block *older; /* the shared block created before */
    struct block *next;  /* the next block of the pool's list, or of the retired blocks of a call */
};

/* Returns the slot's block, which stays valid until slots_unpin. For a stale handle, sets the last error and returns NULL. */
struct block *slots_pin(clk_slot slot);
void slots_unpin(struct block *block); /* NULL does nothing */

/* Assigns a block of at least `capacity` bytes to the slot, and returns this block pinned. The old block, which the caller has pinned, stays valid
 * until slots_unpin. On failure, sets the last error and returns NULL. */
struct block *slots_exchange(clk_slot slot, int32_t capacity);

/* From now on, allocates all memory from the mapping that a child inherits, after its first `reserved` bytes. Blocks that slots already own stay where
 * they are. Returns the start of the mapping. On failure, sets the last error and returns NULL. */
uint8_t *slots_share(uint64_t reserved);

/* Unpins all shared blocks. Call it after the process that used them has ended, when no call is running. */
void slots_unpin_shared(void);

/* Removes a block from the pool whose memory must be returned to the system; NULL if none. The caller deletes the block's wrapper and then calls
 * slots_free. Engine thread only. */
struct block *slots_take_surplus(void);
void slots_free(struct block *block);

/* Returns the number of acquired slots, and the size of the pool in bytes. */
void slots_count(int32_t *taken, uint64_t *bytes);

#endif
