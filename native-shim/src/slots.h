/*
 * The pool of native memory. A slot is a handle with a generation; it owns a block of memory, and another one after it grew.
 * Any thread may call these functions, unless said otherwise.
 */
#ifndef COLLEKTIVE_SLOTS_H
#define COLLEKTIVE_SLOTS_H

#include <stdbool.h>
#include <stdint.h>
#include "collektive_shim.h"

struct block {
    uint8_t *address;
    int32_t capacity;   /* a power of two */
    int32_t pins;       /* calls of the host that use it now */
    bool abandoned;     /* no slot owns it: the last unpin returns it to the pool */
    void *wrapper;      /* global reference to its direct ByteBuffer, or NULL; engine thread only, while pinned */
    struct block *next; /* in the pool: of its list; retired by a call: of that call's list */
};

/* Returns the slot's block, which stays valid until slots_unpin; NULL and CLK_HANDLE as last error for a stale handle. */
struct block *slots_pin(clk_slot slot);
void slots_unpin(struct block *block);

/* Gives the slot another block, of at least `capacity` bytes, and returns it pinned; NULL and the last error when that fails. The
 * old block, which the caller has pinned, stays valid until slots_unpin. */
struct block *slots_exchange(clk_slot slot, int32_t capacity);

/* Takes a block that the pool no longer wants; NULL when there is none. The caller deletes its wrapper and then frees it with slots_free.
 * Engine thread only. */
struct block *slots_take_surplus(void);
void slots_free(struct block *block);

/* Slots taken now, and bytes that the pool holds. */
void slots_count(int32_t *taken, uint64_t *bytes);

#endif
