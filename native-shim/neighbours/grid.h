/* Points in cubic cells: a search around a place costs as much as there are points near it. */
#ifndef NEIGHBOURS_GRID_H
#define NEIGHBOURS_GRID_H

#include <stdbool.h>
#include <stdint.h>
#include "collektive_neighbours.h"

/* Searches need no larger radius, and its square fits a float. */
#define MAX_RADIUS 1e18f

struct cell {
    int32_t x, y, z;
};

struct entry {
    float x, y, z;
    int32_t index;
};

struct grid {
    clk_point *points;
    int32_t count;
    double cells_per_unit;
    struct cell least, most; /* the range of cells with points: a swarm on the ground has one layer */
    uint32_t mask;           /* number of buckets - 1 */

    /* By bucket: the points of one cell are adjacent, ascending by index. */
    struct entry *entries;
    int32_t *rows;
    int32_t *starts; /* by bucket, plus the end of the last one */

    /* By index. */
    int32_t *bucket_of;
    int32_t *row_of;

    int32_t point_capacity, bucket_capacity;
};

/* Results of a search: the index in the high half, the bits of the distance in the low half. */
struct hits {
    uint64_t *keys;
    uint64_t *spare; /* for sorting */
    int32_t count, capacity, spare_capacity;
};

static inline int32_t hit_index(uint64_t key) { return (int32_t)(key >> 32); }

static inline float hit_distance(uint64_t key) {
    union {
        uint32_t bits;
        float value;
    } both = {.bits = (uint32_t)key};
    return both.value;
}

bool grid_place(struct grid *grid, const clk_point *points, int32_t count, float cell);
void grid_free(struct grid *grid);

/* Replaces the hits with the points at inner <= distance <= outer, unordered. Returns false if out of memory. */
bool grid_within(const struct grid *grid, const float place[3], float inner, float outer, struct hits *hits);

/*
 * Replaces the hits with the nearest points other than `except` (an index or -1), ordered by distance and index. `radius` is the initial search
 * radius, and is set to the last one. Returns false if out of memory.
 */
bool grid_nearest(const struct grid *grid, const float place[3], int32_t limit, int32_t except, float *radius, struct hits *hits);

/* Sorts the keys in ascending order. Returns false if out of memory. */
bool hits_sort(struct hits *hits);
void hits_free(struct hits *hits);

#endif
