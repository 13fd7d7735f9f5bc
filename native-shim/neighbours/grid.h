/* A grid of points in cubic cells. The time of a search depends only on the number of points near the place. */
#ifndef NEIGHBOURS_GRID_H
#define NEIGHBOURS_GRID_H

#include <stdbool.h>
#include <stdint.h>
#include "collektive_neighbours.h"

/* Largest radius of a search by growing radius, and largest size of a cell. Its square fits in a float. */
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
    struct cell least, most; /* the range of cells that contain points; searches skip all other cells */
    uint32_t mask;           /* number of buckets - 1; a bucket contains the points of one or more cells */

    /* The points in the order of their buckets. In a bucket, they are in ascending order of their index. */
    struct entry *entries;
    int32_t *rows;   /* number of the row of each entry */
    int32_t *starts; /* first entry of each bucket, and the end of the last bucket */

    /* Bucket and row of each point, by its index. */
    int32_t *bucket_of;
    int32_t *row_of;

    int32_t point_capacity, bucket_capacity;
};

/* The points that a search has found. A key has the point's index in its high half, and the bits of the distance in its low half. */
struct hits {
    uint64_t *keys;
    uint64_t *spare; /* second array, which sorting needs */
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

/* Replaces the hits with the points at inner <= distance <= outer, in no particular order. Returns false if out of memory. */
bool grid_within(const struct grid *grid, const float place[3], float inner, float outer, struct hits *hits);

/*
 * Replaces the hits with the nearest points, in the order of distance and index. Omits the point with the index `except`; -1 omits none. `radius` is
 * the radius with which the search begins, and is set to the radius with which it ends. Returns false if out of memory.
 */
bool grid_nearest(const struct grid *grid, const float place[3], int32_t limit, int32_t except, float *radius, struct hits *hits);

/* Sorts the keys in ascending order. Returns false if out of memory. */
bool hits_sort(struct hits *hits);
void hits_free(struct hits *hits);

#endif
