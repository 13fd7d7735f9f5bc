#include "links.h"

#include <string.h>
#include "array.h"

#define NONE (-1)
#define MAX_PAIRS (1 << 28)
#define PAGE_IDS 4096

static uint32_t bucket_of(const struct links *links, int32_t low, int32_t high) {
    uint32_t mixed = (uint32_t)low * 0x9E3779B1u ^ (uint32_t)high * 0x85EBCA77u;
    return (mixed ^ mixed >> 15) & ((uint32_t)links->capacity - 1);
}

/* In a free pair, `next` encodes the next free pair as a number below -1, by which free pairs are distinguished from those in a chain. */
static int32_t free_link(int32_t next) { return -3 - next; }

static bool is_free(const clk_pair *pair) { return pair->next < NONE; }

static void chain(struct links *links, int32_t index) {
    clk_pair *pair = &links->pairs[index];
    int32_t *head = &links->buckets[bucket_of(links, pair->low, pair->high)];
    pair->next = *head;
    *head = index;
}

static bool grow(struct links *links) {
    int32_t capacity = links->capacity == 0 ? 64 : 2 * links->capacity;
    if (capacity > MAX_PAIRS) return false;
    clk_pair *pairs = realloc(links->pairs, (size_t)capacity * sizeof *pairs);
    if (pairs == NULL) return false;
    links->pairs = pairs;
    int32_t *buckets = realloc(links->buckets, (size_t)capacity * sizeof *buckets);
    if (buckets == NULL) return false;
    links->buckets = buckets;
    links->capacity = capacity;
    memset(buckets, 0xFF, (size_t)capacity * sizeof *buckets);
    for (int32_t i = 0; i < links->used; i++) {
        if (!is_free(&pairs[i])) chain(links, i);
    }
    return true;
}

static int32_t find(const struct links *links, int32_t from, int32_t to) {
    if (links->capacity == 0) return NONE;
    int32_t low = from < to ? from : to;
    int32_t high = from < to ? to : from;
    int32_t index = links->buckets[bucket_of(links, low, high)];
    while (index != NONE && (links->pairs[index].low != low || links->pairs[index].high != high)) index = links->pairs[index].next;
    return index;
}

static int32_t insert(struct links *links, int32_t from, int32_t to) {
    int32_t index = links->first_free - 1;
    if (index >= 0) {
        links->first_free = free_link(links->pairs[index].next) + 1;
    } else {
        if (links->used == links->capacity && !grow(links)) return NONE;
        index = links->used++;
    }
    links->pairs[index] = (clk_pair){.low = from < to ? from : to, .high = from < to ? to : from};
    chain(links, index);
    return index;
}

static void free_pair(struct links *links, int32_t index) {
    clk_pair *pair = &links->pairs[index];
    int32_t *at = &links->buckets[bucket_of(links, pair->low, pair->high)];
    while (*at != index) at = &links->pairs[*at].next;
    *at = pair->next;
    pair->next = free_link(links->first_free - 1);
    links->first_free = index + 1;
}

static bool touch(struct links *links, int32_t index, clk_direction *direction) {
    clk_pair *pair = &links->pairs[index];
    if (!pair->up.is_dirty && !pair->down.is_dirty) {
        if (!reserve(&links->dirty, &links->dirty_capacity, (int64_t)links->dirty_count + 1, sizeof *links->dirty)) return false;
        links->dirty[links->dirty_count++] = index;
    }
    direction->is_dirty = 1;
    return true;
}

static bool add(struct links *links, int32_t index, clk_direction *direction) {
    if (direction->references++ > 0) return true;
    links->count++;
    return touch(links, index, direction);
}

static void mark_stale(struct links *links, clk_direction *direction, bool is_stale) {
    links->stale += is_stale - direction->is_stale;
    direction->is_stale = is_stale;
}

static bool set(struct links *links, int32_t index, clk_direction *direction, float length, float attenuation) {
    mark_stale(links, direction, false);
    if (direction->length == length && direction->attenuation == attenuation) return true;
    direction->length = length;
    direction->attenuation = attenuation;
    return touch(links, index, direction);
}

static bool release(struct links *links, int32_t index, clk_direction *direction) {
    if (--direction->references == 1 && direction->by_script) {
        const struct script *script = &links->scripts[2 * index + (direction == &links->pairs[index].down)];
        return set(links, index, direction, script->length, script->attenuation);
    }
    mark_stale(links, direction, direction->references > 0);
    if (direction->references > 0) return true;
    links->count--;
    return touch(links, index, direction);
}

static clk_direction *direction_of(struct links *links, int32_t index, int32_t from, int32_t to) {
    return from <= to ? &links->pairs[index].up : &links->pairs[index].down;
}

reference links_add(struct links *links, int32_t from, int32_t to, bool both, float length, float attenuation) {
    int32_t index = find(links, from, to);
    if (index == NONE) index = insert(links, from, to);
    if (index == NONE) return -1;
    reference link = (index << 2) | (both ? DIRECTIONS : from <= to ? UP : DOWN);
    clk_pair *pair = &links->pairs[index];
    if ((link & UP) && !add(links, index, &pair->up)) return -1;
    if ((link & DOWN) && !add(links, index, &pair->down)) return -1;
    return links_set(links, link, length, attenuation) ? link : -1;
}

bool links_set(struct links *links, reference link, float length, float attenuation) {
    int32_t index = link >> 2;
    clk_pair *pair = &links->pairs[index];
    return (!(link & UP) || set(links, index, &pair->up, length, attenuation)) &&
           (!(link & DOWN) || set(links, index, &pair->down, length, attenuation));
}

bool links_replace(struct links *links, reference link, float length, float attenuation) {
    const clk_pair *pair = &links->pairs[link >> 2];
    bool is_stale = ((link & UP) && pair->up.is_stale) || ((link & DOWN) && pair->down.is_stale);
    return !is_stale || links_set(links, link, length, attenuation);
}

bool links_release(struct links *links, reference link) {
    int32_t index = link >> 2;
    clk_pair *pair = &links->pairs[index];
    return (!(link & UP) || release(links, index, &pair->up)) && (!(link & DOWN) || release(links, index, &pair->down));
}

bool links_hold(struct links *links, const clk_link *link) {
    /* A new pair has at most the index `used`. */
    if (!reserve(&links->scripts, &links->script_capacity, 2 * ((int64_t)links->used + 1), sizeof *links->scripts)) return false;
    int32_t index = find(links, link->from, link->to);
    if (index == NONE) index = insert(links, link->from, link->to);
    if (index == NONE) return false;
    clk_direction *direction = direction_of(links, index, link->from, link->to);
    if (!direction->by_script && !add(links, index, direction)) return false;
    direction->by_script = 1;
    links->scripts[2 * index + (link->from > link->to)] = (struct script){link->length, link->attenuation};
    /* Rules take precedence. */
    return direction->references > 1 || set(links, index, direction, link->length, link->attenuation);
}

int32_t links_release_script(struct links *links, int32_t from, int32_t to) {
    int32_t index = find(links, from, to);
    if (index == NONE) return 0;
    clk_direction *direction = direction_of(links, index, from, to);
    if (!direction->by_script) return 0;
    direction->by_script = 0;
    return release(links, index, direction) ? 1 : -1;
}

bool links_has(const struct links *links, int32_t from, int32_t to) {
    int32_t index = find(links, from, to);
    return index != NONE && (from <= to ? links->pairs[index].up : links->pairs[index].down).references > 0;
}

static bool has_flag(const struct flags *flags, int32_t id) {
    int32_t page = id / PAGE_IDS;
    return page < flags->capacity && flags->pages[page] != NULL && flags->pages[page][id % PAGE_IDS];
}

static bool set_flag(struct flags *flags, int32_t id, bool value) {
    int32_t page = id / PAGE_IDS, before = flags->capacity;
    if (!reserve(&flags->pages, &flags->capacity, (int64_t)page + 1, sizeof *flags->pages)) return false;
    for (int32_t i = before; i < flags->capacity; i++) flags->pages[i] = NULL;
    if (flags->pages[page] == NULL) flags->pages[page] = calloc(PAGE_IDS, 1);
    if (flags->pages[page] == NULL) return false;
    flags->pages[page][id % PAGE_IDS] = value;
    return true;
}

static void free_flags(struct flags *flags) {
    for (int32_t i = 0; i < flags->capacity; i++) free(flags->pages[i]);
    free(flags->pages);
}

bool links_know(struct links *links, int32_t id, bool known) { return set_flag(&links->known, id, known); }

bool links_mark_gone(struct links *links, const int32_t *ids, int32_t count, bool gone) {
    for (int32_t i = 0; i < count; i++) {
        if (!set_flag(&links->gone, ids[i], gone)) return false;
    }
    return true;
}

bool links_is_gone(const struct links *links, int32_t id) { return has_flag(&links->gone, id); }

static void drop(struct links *links, clk_direction *direction) {
    if (direction->references > 0) links->count--;
    mark_stale(links, direction, false);
    direction->references = 0;
    direction->is_sent = 0;
    direction->by_script = 0;
}

void links_drop_gone(struct links *links) {
    for (int32_t index = 0; index < links->used; index++) {
        clk_pair *pair = &links->pairs[index];
        if (is_free(pair) || (!links_is_gone(links, pair->low) && !links_is_gone(links, pair->high))) continue;
        drop(links, &pair->up);
        drop(links, &pair->down);
        /* A dirty pair is freed later, by links_flush. */
        if (!pair->up.is_dirty && !pair->down.is_dirty) free_pair(links, index);
    }
}

static void flush(clk_direction *direction, int32_t from, int32_t to, clk_link *sets, clk_link_ends *removals, clk_changes *changes) {
    if (!direction->is_dirty) return;
    direction->is_dirty = 0;
    if (direction->references > 0)
        sets[changes->set_count++] = (clk_link){from, to, direction->length, direction->attenuation};
    else if (direction->is_sent)
        removals[changes->removed_count++] = (clk_link_ends){from, to};
    direction->is_sent = direction->references > 0;
}

bool links_flush(struct links *links, clk_changes *changes) {
    *changes = (clk_changes){0};
    int64_t most = 2 * (int64_t)links->dirty_count;
    if (!reserve(&links->set, &links->set_capacity, most, sizeof *links->set)) return false;
    if (!reserve(&links->removed, &links->removed_capacity, most, sizeof *links->removed)) return false;
    int32_t waiting = 0;
    for (int32_t i = 0; i < links->dirty_count; i++) {
        int32_t index = links->dirty[i];
        clk_pair *pair = &links->pairs[index];
        bool referenced = pair->up.references > 0 || pair->down.references > 0;
        if (referenced && !(has_flag(&links->known, pair->low) && has_flag(&links->known, pair->high))) {
            links->dirty[waiting++] = index;
            continue;
        }
        flush(&pair->up, pair->low, pair->high, links->set, links->removed, changes);
        flush(&pair->down, pair->high, pair->low, links->set, links->removed, changes);
        if (!referenced) free_pair(links, index);
    }
    links->dirty_count = waiting;
    changes->set = links->set;
    changes->removed = links->removed;
    return true;
}

void links_free(struct links *links) {
    free(links->pairs);
    free(links->buckets);
    free(links->scripts);
    free(links->dirty);
    free_flags(&links->known);
    free_flags(&links->gone);
    free(links->set);
    free(links->removed);
}
