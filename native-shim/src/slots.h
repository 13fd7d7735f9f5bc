/*
 * The pool of native memory. A slot is a handle with a generation; behind it lies a block of memory that can be exchanged.
 * The functions of the header are here too. Any thread.
 */
#ifndef COLLEKTIVE_SLOTS_H
#define COLLEKTIVE_SLOTS_H

#include <stdbool.h>
#include <stdint.h>
#include "collektive_shim.h"

struct block {
    uint8_t *address;
    int32_t capacity;   /* a power of two */
    int32_t pins;       /* calls into the JVM that read or write it now */
    bool abandoned;     /* no slot has it any more: the last unpin gives it to the pool */
    void *wrapper;      /* global reference to its direct ByteBuffer, or NULL; engine thread, while pinned */
    struct block *next; /* in the list that holds it; while pinned, the call's */
};

/* The slot's block, kept alive and in place until slots_unpin. NULL with CLK_HANDLE as last error. */
struct block *slots_pin(clk_slot slot);
void slots_unpin(struct block *block);

/* Gives the slot a larger block, pinned. The old one stays valid while it is pinned. NULL with the last error set. */
struct block *slots_exchange(clk_slot slot, int32_t capacity);

/* Takes a block that the pool no longer wants, but whose wrapper must go first; NULL when there is none. Engine thread.
 * slots_free ends it. */
struct block *slots_take_surplus(void);
void slots_free(struct block *block);

/* Slots taken now, and bytes that the pool holds. */
void slots_count(int32_t *taken, uint64_t *bytes);

#endif
