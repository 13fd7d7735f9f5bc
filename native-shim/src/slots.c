#include "slots.h"

#include <stdlib.h>
#include <string.h>
#include "error.h"
#include "prim.h"

#define MAX_CAPACITY (1 << 30)
#define MIN_CLASS 12 /* blocks are 2^12 .. 2^30 bytes */
#define MAX_CLASS 30

/* The pool keeps this much unused memory and returns the rest to the system. */
#define MAX_UNUSED_BYTES ((uint64_t)64 << 20)

struct slot {
    uint32_t generation;
    uint32_t next_free;  /* index + 1 of the next free slot, 0 at the end */
    struct block *block; /* NULL while free */
};

static struct {
    prim_mutex mutex;
    struct slot *slots;
    uint32_t length;
    uint32_t capacity;
    uint32_t first_free;
    int32_t taken;
    uint64_t bytes;
    uint64_t unused_bytes;
    struct block *unused[MAX_CLASS + 1]; /* list of unused blocks of each class */
    struct block *surplus;               /* blocks to be freed once the engine thread has deleted their wrappers */

    uint8_t *shared; /* NULL until slots_share; after that, all new blocks are ranges of this memory, which are never split */
    uint64_t shared_end;
    struct block *newest; /* the newest shared block; shared blocks are never freed */
} pool = {.mutex = PRIM_MUTEX_INIT};

/* ---- Blocks (under the mutex) ---------------------------------------------------------------------------------------- */

static int class_of(int32_t capacity) {
    int class = MIN_CLASS;
    while ((1 << class) < capacity) class++;
    return class;
}

/* Returns a new block. The memory of a shared block is not committed yet. NULL if out of memory. */
static struct block *block_create(int class) {
    uint64_t bytes = (uint64_t)1 << class;
    struct block *block = malloc(sizeof *block);
    if (block == NULL) return NULL;
    *block = (struct block){.capacity = 1 << class};
    if (pool.shared == NULL) {
        block->address = prim_allocate(bytes);
    } else if (PRIM_SHARED_BYTES - pool.shared_end >= bytes) {
        *block = (struct block){
            .address = pool.shared + pool.shared_end, .offset = pool.shared_end, .capacity = 1 << class, .older = pool.newest};
        pool.newest = block;
        pool.shared_end += bytes;
    }
    if (block->address != NULL) return block;
    free(block);
    return NULL;
}

static void block_keep(struct block *block) {
    int class = class_of(block->capacity);
    block->next = pool.unused[class];
    pool.unused[class] = block;
    if (block->counted) pool.unused_bytes += (uint64_t)block->capacity;
}

static struct block *block_take(int32_t capacity) {
    int class = class_of(capacity);
    struct block *block = pool.unused[class];
    if (block != NULL) {
        pool.unused[class] = block->next;
        if (block->counted) pool.unused_bytes -= (uint64_t)block->capacity;
    } else {
        block = block_create(class);
    }
    if (block != NULL && !block->counted && block->offset != 0 && !prim_shared_commit(block->offset, (uint64_t)block->capacity, true)) {
        block_keep(block);
        block = NULL;
    }
    if (block == NULL) {
        error_set(CLK_MEMORY, "out of native memory for a slot of %d bytes", 1 << class);
        return NULL;
    }
    if (!block->counted) pool.bytes += (uint64_t)block->capacity;
    block->counted = true;
    block->next = NULL;
    return block;
}

/* Keeps the block for another slot, or returns its memory to the system. A shared block keeps its address in both cases. */
static void block_release(struct block *block) {
    bool is_shared = block->offset != 0;
    bool fits = pool.unused_bytes + (uint64_t)block->capacity <= MAX_UNUSED_BYTES && is_shared == (pool.shared != NULL);
    block->abandoned = false;
    block->counted = fits || (is_shared && !prim_shared_commit(block->offset, (uint64_t)block->capacity, false));
    if (!block->counted) pool.bytes -= (uint64_t)block->capacity;
    if (is_shared || fits) {
        block_keep(block);
    } else if (block->wrapper == NULL) {
        slots_free(block);
    } else {
        block->next = pool.surplus;
        pool.surplus = block;
    }
}

/* Detaches the block from its slot. It stays valid until its last unpin. */
static void block_abandon(struct block *block) {
    if (block->pins == 0) {
        block_release(block);
    } else {
        block->abandoned = true;
    }
}

/* ---- Slots (under the mutex) ----------------------------------------------------------------------------------------- */

static struct slot *slot_find(clk_slot handle) {
    uint32_t index = (uint32_t)handle;
    if (index >= pool.length || pool.slots[index].block == NULL || pool.slots[index].generation != handle >> 32) {
        error_set(CLK_HANDLE, "slot 0x%llx is already released or was never issued; acquire a new one", (unsigned long long)handle);
        return NULL;
    }
    return &pool.slots[index];
}

/* Returns the index of a free slot, or -1 if out of memory. */
static int64_t slot_take(void) {
    if (pool.first_free != 0) {
        uint32_t index = pool.first_free - 1;
        pool.first_free = pool.slots[index].next_free;
        return index;
    }
    if (pool.length == pool.capacity) {
        uint32_t capacity = pool.capacity == 0 ? 64 : pool.capacity * 2;
        struct slot *slots = realloc(pool.slots, capacity * sizeof *slots);
        if (slots == NULL) return -1;
        pool.slots = slots;
        pool.capacity = capacity;
    }
    pool.slots[pool.length] = (struct slot){.generation = 1};
    return pool.length++;
}

static void slot_free(struct slot *slot) {
    slot->block = NULL;
    slot->generation = slot->generation == UINT32_MAX ? 1 : slot->generation + 1; /* 0 would allow a handle 0 */
    slot->next_free = pool.first_free;
    pool.first_free = (uint32_t)(slot - pool.slots) + 1;
}

/* ---- The header's functions ------------------------------------------------------------------------------------------ */

static int32_t check_capacity(int32_t capacity) {
    if (capacity >= 1 && capacity <= MAX_CAPACITY) return CLK_OK;
    return error_set(CLK_ARGUMENT, "capacity is %d; it must be 1 to %d bytes", capacity, MAX_CAPACITY);
}

static int32_t check_memory(const clk_memory *memory) {
    if (memory == NULL) return error_set(CLK_ARGUMENT, "memory is NULL");
    if (memory->size >= sizeof *memory) return CLK_OK;
    return error_set(CLK_ARGUMENT, "memory->size is %u; set it to sizeof(clk_memory)", memory->size);
}

static void fill_memory(const struct block *block, clk_memory *memory) {
    memory->capacity = block->capacity;
    memory->address = block->address;
}

int32_t clk_slot_acquire(int32_t capacity, clk_slot *slot, clk_memory *memory) {
    if (slot == NULL) return error_set(CLK_ARGUMENT, "slot is NULL");
    if (check_memory(memory) != CLK_OK || check_capacity(capacity) != CLK_OK) return CLK_ARGUMENT;
    prim_lock(&pool.mutex);
    int32_t result = CLK_MEMORY;
    struct block *block = block_take(capacity);
    if (block != NULL) {
        int64_t index = slot_take();
        if (index < 0) {
            block_release(block);
            error_set(CLK_MEMORY, "out of native memory for more than %u slots; release some", pool.length);
        } else {
            pool.slots[index].block = block;
            pool.taken++;
            *slot = (uint64_t)pool.slots[index].generation << 32 | (uint32_t)index;
            fill_memory(block, memory);
            result = CLK_OK;
        }
    }
    prim_unlock(&pool.mutex);
    return result;
}

static int32_t grow(clk_slot handle, int32_t capacity, int32_t keep, clk_memory *memory) {
    struct slot *slot = slot_find(handle);
    if (slot == NULL) return CLK_HANDLE;
    struct block *old = slot->block;
    if (keep < 0 || keep > old->capacity)
        return error_set(CLK_ARGUMENT, "keep is %d; it must be 0 to %d, the size of the slot", keep, old->capacity);
    if (old->pins > 0) return error_set(CLK_ARGUMENT, "the slot is in use by a running call; grow it after the call");
    if (capacity > old->capacity) {
        struct block *block = block_take(capacity);
        if (block == NULL) return CLK_MEMORY;
        memcpy(block->address + block->capacity - keep, old->address + old->capacity - keep, (size_t)keep);
        slot->block = block;
        block_abandon(old);
    }
    fill_memory(slot->block, memory);
    return CLK_OK;
}

int32_t clk_slot_grow(clk_slot slot, int32_t capacity, int32_t keep, clk_memory *memory) {
    if (check_memory(memory) != CLK_OK || check_capacity(capacity) != CLK_OK) return CLK_ARGUMENT;
    prim_lock(&pool.mutex);
    int32_t result = grow(slot, capacity, keep, memory);
    prim_unlock(&pool.mutex);
    return result;
}

int32_t clk_slot_release(clk_slot handle) {
    prim_lock(&pool.mutex);
    struct slot *slot = slot_find(handle);
    if (slot != NULL) {
        block_abandon(slot->block);
        slot_free(slot);
        pool.taken--;
    }
    prim_unlock(&pool.mutex);
    return slot != NULL ? CLK_OK : CLK_HANDLE;
}

/* ---- For calls into the JVM ------------------------------------------------------------------------------------------ */

struct block *slots_pin(clk_slot handle) {
    prim_lock(&pool.mutex);
    struct slot *slot = slot_find(handle);
    struct block *block = slot != NULL ? slot->block : NULL;
    if (block != NULL) block->pins++;
    prim_unlock(&pool.mutex);
    return block;
}

void slots_unpin(struct block *block) {
    if (block == NULL) return;
    prim_lock(&pool.mutex);
    if (--block->pins == 0 && block->abandoned) block_release(block);
    prim_unlock(&pool.mutex);
}

struct block *slots_exchange(clk_slot handle, int32_t capacity) {
    if (check_capacity(capacity) != CLK_OK) return NULL;
    prim_lock(&pool.mutex);
    struct slot *slot = slot_find(handle);
    struct block *block = slot != NULL ? block_take(capacity) : NULL;
    if (block != NULL) {
        block->pins++;
        block_abandon(slot->block);
        slot->block = block;
    }
    prim_unlock(&pool.mutex);
    return block;
}

uint8_t *slots_share(uint64_t reserved) {
    char why[256];
    prim_lock(&pool.mutex);
    if (pool.shared == NULL) {
        uint8_t *shared = prim_shared_reserve(why, sizeof why);
        if (shared == NULL || !prim_shared_commit(0, reserved, true)) {
            error_set(CLK_MEMORY, "cannot share memory with the JVM's process: %s; free memory, or run the JVM in this process",
                      shared == NULL ? why : "out of memory");
        } else {
            for (int class = MIN_CLASS; class <= MAX_CLASS; class++) {
                for (struct block *block; (block = pool.unused[class]) != NULL; slots_free(block)) {
                    pool.unused[class] = block->next;
                    pool.bytes -= (uint64_t)block->capacity;
                }
            }
            pool.unused_bytes = 0;
            pool.shared_end = reserved;
            pool.shared = shared;
        }
    }
    prim_unlock(&pool.mutex);
    return pool.shared;
}

void slots_unpin_shared(void) {
    prim_lock(&pool.mutex);
    for (struct block *block = pool.newest; block != NULL; block = block->older) {
        if (block->pins > 0 && block->abandoned) block_release(block);
        block->pins = 0;
    }
    prim_unlock(&pool.mutex);
}

struct block *slots_take_surplus(void) {
    prim_lock(&pool.mutex);
    struct block *block = pool.surplus;
    if (block != NULL) pool.surplus = block->next;
    prim_unlock(&pool.mutex);
    return block;
}

void slots_free(struct block *block) {
    prim_free(block->address);
    free(block);
}

void slots_count(int32_t *taken, uint64_t *bytes) {
    prim_lock(&pool.mutex);
    *taken = pool.taken;
    *bytes = pool.bytes;
    prim_unlock(&pool.mutex);
}
