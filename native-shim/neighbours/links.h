/* All links with their reference counts, and the changes that have not been flushed yet. */
#ifndef NEIGHBOURS_LINKS_H
#define NEIGHBOURS_LINKS_H

#include <stdbool.h>
#include <stdint.h>
#include "collektive_neighbours.h"

/* A flag for each id. Ids may be far apart, so the flags are in pages that are allocated on first use. */
struct flags {
    uint8_t **pages;
    int32_t capacity; /* length of `pages` */
};

/* The values that a script set for a link. The link has them whenever no rule references it. */
struct script {
    float length, attenuation;
};

/* Most links exist in both directions. Therefore the table contains pairs of links, and one reference may cover both links of a pair. */
struct links {
    clk_pair *pairs;
    int32_t *buckets; /* hash table of the pairs; its size is `capacity`, a power of two */
    int32_t used, capacity, first_free;
    int32_t count; /* number of links */
    int32_t stale; /* number of links whose values may be those of a rule or script that released them */

    struct script *scripts; /* for the up and down link of each pair, as far as scripts have set values */
    int32_t script_capacity;

    int32_t *dirty; /* pairs in which a direction has changed */
    int32_t dirty_count, dirty_capacity;

    struct flags known; /* ids that the receiver of links_flush knows */
    struct flags gone;  /* ids that are being dropped; all flags are 0 between calls */

    clk_link *set;
    clk_link_ends *removed;
    int32_t set_capacity, removed_capacity;
};

/* A reference to one or both links of a pair: the number of the pair, shifted by 2, and the directions. */
typedef int32_t reference;
enum { UP = 1, DOWN = 2, DIRECTIONS = 3 };

/* Returns whether two lengths differ by more than a tolerance. */
static inline bool is_beyond(float a, float b, float tolerance) { return a - b > tolerance || b - a > tolerance; }

/* Adds a reference to a link, or to both links of a pair, and sets their values. Returns the reference, or a negative number if out of memory. */
reference links_add(struct links *links, int32_t from, int32_t to, bool both, float length, float attenuation);
bool links_set(struct links *links, reference link, float length, float attenuation);
/* Sets the values of a link if they may be those of a rule or script that released it. */
bool links_replace(struct links *links, reference link, float length, float attenuation);
bool links_release(struct links *links, reference link);

/* Loads a link into the cache. */
static inline void links_prefetch(const struct links *links, reference link) { __builtin_prefetch(&links->pairs[link >> 2], 1); }

bool links_hold(struct links *links, const clk_link *link);
/* Returns 0 if scripts did not reference the link, otherwise 1; a negative number if out of memory. */
int32_t links_release_script(struct links *links, int32_t from, int32_t to);
bool links_has(const struct links *links, int32_t from, int32_t to);

bool links_know(struct links *links, int32_t id, bool known);
/* Marks ids as gone, so that links_drop_gone removes their links, or removes the marks. */
bool links_mark_gone(struct links *links, const int32_t *ids, int32_t count, bool gone);
bool links_is_gone(const struct links *links, int32_t id);
void links_drop_gone(struct links *links);

bool links_flush(struct links *links, clk_changes *changes);
void links_free(struct links *links);

#endif
