#include "grid.h"

#include <math.h>
#include <string.h>
#include "array.h"

/* Largest coordinate of a cell, which must fit in an int32_t. */
#define MAX_CELLS (1 << 30)
/* Largest number of rows in a search. With more rows, several would have the same number. */
#define MAX_ROWS 0xFFFF
#define MIN_RADIUS 1e-3f
/* Length of the runs that are sorted by insertion before they are merged. */
enum { RUN = 16 };

static inline int32_t min(int32_t a, int32_t b) { return a < b ? a : b; }
static inline int32_t max(int32_t a, int32_t b) { return a > b ? a : b; }

static inline int32_t cell_of(const struct grid *grid, double coordinate) {
    double cell = coordinate * grid->cells_per_unit;
    if (!(cell > -MAX_CELLS)) return -MAX_CELLS;
    if (cell >= MAX_CELLS) return MAX_CELLS;
    int32_t towards_zero = (int32_t)cell;
    return cell < towards_zero ? towards_zero - 1 : towards_zero;
}

/* Returns the number of a row of cells along x, unique among the rows of one search. */
static inline int32_t row_of(int32_t y, int32_t z) { return (int32_t)((uint32_t)y << 16 | ((uint32_t)z & MAX_ROWS)); }

/* Returns the bucket of a cell. Cells that are adjacent along x have adjacent buckets, so the entries of a row of cells are one range. */
static inline uint32_t bucket_of(const struct grid *grid, int32_t x, int32_t row) {
    uint32_t mixed = (uint32_t)row * 0x9E3779B1u;
    return ((uint32_t)x + (mixed ^ mixed >> 15)) & grid->mask;
}

static bool resize(struct grid *grid, int32_t count) {
    if (count > grid->point_capacity || grid->points == NULL) {
        int32_t capacity = max(64, max(count, 2 * grid->point_capacity));
        size_t length = (size_t)capacity;
        clk_point *points = realloc(grid->points, length * sizeof *points);
        if (points != NULL) grid->points = points;
        struct entry *entries = realloc(grid->entries, length * sizeof *entries);
        if (entries != NULL) grid->entries = entries;
        int32_t *rows = realloc(grid->rows, length * sizeof *rows);
        if (rows != NULL) grid->rows = rows;
        int32_t *buckets = realloc(grid->bucket_of, length * sizeof *buckets);
        if (buckets != NULL) grid->bucket_of = buckets;
        int32_t *all_rows = realloc(grid->row_of, length * sizeof *all_rows);
        if (all_rows != NULL) grid->row_of = all_rows;
        if (points == NULL || entries == NULL || rows == NULL || buckets == NULL || all_rows == NULL) return false;
        grid->point_capacity = capacity;
    }
    int64_t buckets = 128;
    while (buckets < 2 * (int64_t)count) buckets *= 2;
    grid->mask = (uint32_t)buckets - 1;
    return reserve(&grid->starts, &grid->bucket_capacity, buckets + 1, sizeof *grid->starts);
}

bool grid_place(struct grid *grid, const clk_point *points, int32_t count, float cell) {
    if (!resize(grid, count)) return false;
    grid->count = count;
    grid->cells_per_unit = 1 / (double)(cell < MIN_RADIUS ? MIN_RADIUS : cell > MAX_RADIUS ? MAX_RADIUS : cell);
    grid->least = (struct cell){INT32_MAX, INT32_MAX, INT32_MAX};
    grid->most = (struct cell){INT32_MIN, INT32_MIN, INT32_MIN};
    int32_t *starts = grid->starts;
    memset(starts, 0, (grid->mask + 2) * sizeof *starts);
    if (count > 0) memcpy(grid->points, points, (size_t)count * sizeof *points);
    for (int32_t i = 0; i < count; i++) {
        struct cell at = {cell_of(grid, points[i].x), cell_of(grid, points[i].y), cell_of(grid, points[i].z)};
        grid->least = (struct cell){min(grid->least.x, at.x), min(grid->least.y, at.y), min(grid->least.z, at.z)};
        grid->most = (struct cell){max(grid->most.x, at.x), max(grid->most.y, at.y), max(grid->most.z, at.z)};
        int32_t row = row_of(at.y, at.z);
        uint32_t bucket = bucket_of(grid, at.x, row);
        grid->row_of[i] = row;
        grid->bucket_of[i] = (int32_t)bucket;
        starts[bucket + 1]++;
    }
    for (uint32_t bucket = 0; bucket <= grid->mask; bucket++) starts[bucket + 1] += starts[bucket];
    for (int32_t i = count - 1; i >= 0; i--) {
        int32_t place = --starts[grid->bucket_of[i] + 1];
        grid->entries[place] = (struct entry){points[i].x, points[i].y, points[i].z, i};
        grid->rows[place] = grid->row_of[i];
    }
    /* Each starts[bucket + 1] is now the beginning of `bucket`, so all are moved back by one. */
    memmove(starts, starts + 1, (grid->mask + 1) * sizeof *starts);
    starts[grid->mask + 1] = count;
    return true;
}

void grid_free(struct grid *grid) {
    free(grid->points);
    free(grid->entries);
    free(grid->rows);
    free(grid->starts);
    free(grid->bucket_of);
    free(grid->row_of);
}

/* Appends the entries of a range whose squared distances are in a band. Unless `any_row` is set, omits the entries of other rows, which may be in the same
 * buckets. */
static bool append_hits(const struct grid *grid, int32_t start, int32_t end, const float place[3], const float band[2], bool any_row,
                        int32_t row, struct hits *hits) {
    if (start >= end) return true;
    if (!reserve(&hits->keys, &hits->capacity, (int64_t)hits->count + (end - start), sizeof *hits->keys)) return false;
    const struct entry *entries = grid->entries;
    const int32_t *rows = grid->rows;
    float x = place[0], y = place[1], z = place[2], least = band[0], most = band[1];
    uint64_t *keys = hits->keys;
    int32_t found = hits->count;
    for (int32_t i = start; i < end; i++) {
        float dx = entries[i].x - x;
        float dy = entries[i].y - y;
        float dz = entries[i].z - z;
        union {
            float value;
            uint32_t bits;
        } squared = {.value = dx * dx + dy * dy + dz * dz};
        /* Every key is written, and only hits are counted. A branch would be slow, because the processor cannot predict which points are near. */
        keys[found] = (uint64_t)(uint32_t)entries[i].index << 32 | squared.bits;
        found += (squared.value <= most) & (squared.value >= least) & (any_row | (rows[i] == row));
    }
    hits->count = found;
    return true;
}

/* Replaces the hits with the points between two distances. Their keys contain squared distances. */
static bool collect(const struct grid *grid, const float place[3], float inner, float outer, struct hits *hits) {
    hits->count = 0;
    if (!(outer >= 0) || !(inner <= outer)) return true;
    float band[2] = {inner > 0 ? inner * inner : 0, outer * outer};
    /* The cells must reach slightly farther than `outer`, because distances are rounded. */
    double reach = outer * (1 + 1e-6);
    struct cell first = {max(cell_of(grid, place[0] - reach), grid->least.x), max(cell_of(grid, place[1] - reach), grid->least.y),
                         max(cell_of(grid, place[2] - reach), grid->least.z)};
    struct cell last = {min(cell_of(grid, place[0] + reach), grid->most.x), min(cell_of(grid, place[1] + reach), grid->most.y),
                        min(cell_of(grid, place[2] + reach), grid->most.z)};
    int64_t length = (int64_t)last.x - first.x + 1;
    int64_t rows = ((int64_t)last.y - first.y + 1) * ((int64_t)last.z - first.z + 1);
    if (length <= 0) return true;
    /* If the cells outnumber the points, all points are checked. The number of cells may exceed the range of int64_t, so it is a double. */
    if ((double)length * (double)rows > grid->count || rows > MAX_ROWS)
        return append_hits(grid, 0, grid->count, place, band, true, 0, hits);
    for (int32_t y = first.y; y <= last.y; y++) {
        for (int32_t z = first.z; z <= last.z; z++) {
            int32_t row = row_of(y, z);
            int64_t start = bucket_of(grid, first.x, row);
            int64_t end = start + length, buckets = (int64_t)grid->mask + 1;
            if (!append_hits(grid, grid->starts[start], grid->starts[end < buckets ? end : buckets], place, band, false, row, hits))
                return false;
            if (end > buckets && !append_hits(grid, 0, grid->starts[end - buckets], place, band, false, row, hits)) return false;
        }
    }
    return true;
}

static void to_distances(struct hits *hits) {
    for (int32_t i = 0; i < hits->count; i++) {
        union {
            float value;
            uint32_t bits;
        } distance = {.value = sqrtf(hit_distance(hits->keys[i]))};
        hits->keys[i] = (hits->keys[i] >> 32 << 32) | distance.bits;
    }
}

bool grid_within(const struct grid *grid, const float place[3], float inner, float outer, struct hits *hits) {
    if (!collect(grid, place, inner, outer, hits)) return false;
    to_distances(hits);
    return true;
}

/* Exchanges the halves of a key, so that keys are ordered by distance, then by index. */
static inline uint64_t by_distance(uint64_t key) { return key << 32 | key >> 32; }

bool grid_nearest(const struct grid *grid, const float place[3], int32_t limit, int32_t except, float *radius, struct hits *hits) {
    float reach = *radius < MIN_RADIUS ? MIN_RADIUS : *radius;
    int64_t wanted = limit;
    if (except >= 0) wanted++;
    if (!collect(grid, place, 0, reach, hits)) return false;
    while (hits->count < wanted && hits->count < grid->count && reach < MAX_RADIUS) {
        reach *= 2;
        if (!collect(grid, place, 0, reach, hits)) return false;
    }
    to_distances(hits);
    *radius = reach;
    int32_t sorted = 0;
    for (int32_t i = 0; i < hits->count; i++) {
        uint64_t key = hits->keys[i];
        if (hit_index(key) == except) continue;
        key = by_distance(key);
        if (sorted == limit && (limit == 0 || key >= hits->keys[sorted - 1])) continue;
        int32_t at = sorted < limit ? sorted++ : sorted - 1;
        /* Inserts the key into the sorted keys. The place that is overwritten contains a key that was already read, or the farthest key so far. */
        for (; at > 0 && key < hits->keys[at - 1]; at--) hits->keys[at] = hits->keys[at - 1];
        hits->keys[at] = key;
    }
    hits->count = sorted;
    for (int32_t i = 0; i < sorted; i++) hits->keys[i] = by_distance(hits->keys[i]);
    return true;
}

static void sort_run(uint64_t *keys, int32_t count) {
    for (int32_t next = 1; next < count; next++) {
        uint64_t key = keys[next];
        int32_t at = next;
        for (; at > 0 && key < keys[at - 1]; at--) keys[at] = keys[at - 1];
        keys[at] = key;
    }
}

bool hits_sort(struct hits *hits) {
    int32_t count = hits->count;
    for (int32_t start = 0; start < count; start += RUN) sort_run(hits->keys + start, min(RUN, count - start));
    if (count <= RUN) return true;
    if (!reserve(&hits->spare, &hits->spare_capacity, hits->capacity, sizeof *hits->spare)) return false;
    for (int64_t run = RUN; run < count; run *= 2) {
        uint64_t *from = hits->keys, *to = hits->spare;
        for (int64_t start = 0; start < count; start += 2 * run) {
            int64_t middle = start + run < count ? start + run : count;
            int64_t end = start + 2 * run < count ? start + 2 * run : count;
            for (int64_t a = start, b = middle, at = start; at < end; at++)
                to[at] = b == end || (a < middle && from[a] < from[b]) ? from[a++] : from[b++];
        }
        hits->keys = to;
        hits->spare = from;
        int32_t capacity = hits->capacity;
        hits->capacity = hits->spare_capacity;
        hits->spare_capacity = capacity;
    }
    return true;
}

void hits_free(struct hits *hits) {
    free(hits->keys);
    free(hits->spare);
}
