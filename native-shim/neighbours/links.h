/* All links with their reference counts, and the changes that are not flushed yet. */
#ifndef NEIGHBOURS_LINKS_H
#define NEIGHBOURS_LINKS_H

#include <stdbool.h>
#include <stdint.h>
#include "collektive_neighbours.h"

/* A flag for each id, in pages that are allocated on first use, because ids may be far apart. */
struct flags {
    uint8_t **pages;
    int32_t capacity; /* of pages */
};

/* Most links come and go in pairs, so the two links of a pair are adjacent, and one reference may cover both. */
struct links {
    clk_pair *pairs;
    int32_t *buckets; /* as many as the capacity of pairs, a power of two */
    int32_t used, capacity, first_free;
    int32_t count; /* of links */

    int32_t *dirty; /* pairs with a changed direction */
    int32_t dirty_count, dirty_capacity;

    struct flags known;
    struct flags gone; /* all 0 between calls */

    clk_link *set;
    clk_link_ends *removed;
    int32_t set_capacity, removed_capacity;
};

/* A reference to the links of a pair: its number, and the directions. */
typedef int32_t reference;
enum { UP = 1, DOWN = 2, DIRECTIONS = 3 };

/* Adds a reference to a link, or to both links of a pair, and returns it; negative if out of memory. */
reference links_add(struct links *links, int32_t from, int32_t to, bool both, float length, float attenuation);
bool links_set(struct links *links, reference link, float length, float attenuation);
bool links_release(struct links *links, reference link);

/* Loads a link into the cache. */
static inline void links_prefetch(const struct links *links, reference link) { __builtin_prefetch(&links->pairs[link >> 2], 1); }

bool links_hold(struct links *links, const clk_link *link);
/* Returns 0 if scripts have no reference, otherwise 1; negative if out of memory. */
int32_t links_release_script(struct links *links, int32_t from, int32_t to);
bool links_has(const struct links *links, int32_t from, int32_t to);

bool links_know(struct links *links, int32_t id, bool known);
/* Marks ids as gone, or as present. */
bool links_mark_gone(struct links *links, const int32_t *ids, int32_t count, bool gone);
bool links_is_gone(const struct links *links, int32_t id);
void links_drop_gone(struct links *links);

bool links_flush(struct links *links, clk_changes *changes);
void links_free(struct links *links);

#endif
