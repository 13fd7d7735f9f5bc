/* Arrays that grow. */
#ifndef NEIGHBOURS_ARRAY_H
#define NEIGHBOURS_ARRAY_H

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

/* Makes room for `needed` items of `size` bytes each. `items` is the address of the pointer to the array. Returns false if out of memory. */
static inline bool reserve(void *items, int32_t *capacity, int64_t needed, size_t size) {
    if (needed <= *capacity) return true;
    int64_t larger = 2 * (int64_t)*capacity > needed ? 2 * (int64_t)*capacity : needed;
    if (larger < 16) larger = 16;
    if (larger > INT32_MAX) return false;
    void **array = items;
    void *grown = realloc(*array, (size_t)larger * size);
    if (grown == NULL) return false;
    *array = grown;
    *capacity = (int32_t)larger;
    return true;
}

#endif
