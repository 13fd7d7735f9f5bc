#include "collektive_neighbours.h"

#include <limits.h>
#include <math.h>
#include <stdatomic.h>
#include <string.h>
#include "array.h"
#include "grid.h"
#include "links.h"
#include "workers.h"

/* Number of searches that a thread claims at a time. */
#define CHUNK 64
/* With fewer searches, only one thread is used. They take less than half a millisecond, and the scheduling of another thread can take longer. */
#define MIN_SEARCHES 2048
/* After this number of changes, the threads stop and the links are updated. This limits the memory of a tick in which all links are new. */
#define MAX_NEW_LINKS (1 << 18)

/* A link that a rule references. */
struct held {
    int32_t id;
    float length;
    float attenuation;
    reference link;
};

struct rule {
    struct held *held; /* links of the rule, in ascending order of id */
    int32_t count, capacity;
    int32_t next_free; /* number + 1 of the next removed rule; -1 if the rule is in use */
    int32_t centre;    /* id */
    uint32_t update;   /* number of the last update that contained the rule */
    float reach;       /* distance of the farthest point that the last search for nearest points found */
};

enum change_kind { NONE, ADD, ADD_BOTH, SET, REPLACE, RELEASE };

/* Number of items by which prefetches are ahead. Links and rules are far apart in memory, so loading them takes long. */
enum { AHEAD = 8 };

struct change {
    enum change_kind kind;
    int32_t target; /* for a new link, its place in `held`; otherwise the reference */
    float length;
    float attenuation;
};

/* The changes of a search. They are in the memory of the thread that ran it. */
struct changes {
    int32_t thread, first, count;
};

/* Memory of a thread. The padding separates the cache lines of different threads. */
struct thread_memory {
    struct hits hits;
    clk_neighbour *requested;
    struct held *merged;
    struct change *changes;
    int32_t requested_capacity, merged_capacity, change_count, change_capacity;
    double radius_sum;
    int32_t searches;
    char padding[128];
};

struct clk_neighbours {
    struct grid grid;
    struct links links;
    struct workers *workers;
    struct rule *rules;
    int32_t rule_count, rule_capacity, free_rule; /* free_rule: number + 1 of the first removed rule */
    float cell;
    clk_near *found;
    int32_t found_capacity;
    struct changes *changes; /* changes of each search */
    int32_t changes_capacity;

    /* The update in progress. */
    const clk_search *searches;
    int32_t search_count;
    uint32_t update;
    bool replaces; /* searches replace stale values of links */
    atomic_int next;
    atomic_int new_links;
    atomic_bool is_out_of_memory;

    struct thread_memory threads[MAX_WORKERS];
};

clk_neighbours *clk_neighbours_create(void) {
    clk_neighbours *neighbours = calloc(1, sizeof *neighbours);
    if (neighbours == NULL) return NULL;
    neighbours->workers = workers_create();
    neighbours->cell = 1;
    if (neighbours->workers != NULL && grid_place(&neighbours->grid, NULL, 0, 1)) return neighbours;
    clk_neighbours_destroy(neighbours);
    return NULL;
}

void clk_neighbours_destroy(clk_neighbours *neighbours) {
    if (neighbours == NULL) return;
    workers_destroy(neighbours->workers);
    grid_free(&neighbours->grid);
    links_free(&neighbours->links);
    for (int32_t i = 0; i < neighbours->rule_count; i++) free(neighbours->rules[i].held);
    for (int32_t i = 0; i < MAX_WORKERS; i++) {
        hits_free(&neighbours->threads[i].hits);
        free(neighbours->threads[i].requested);
        free(neighbours->threads[i].merged);
        free(neighbours->threads[i].changes);
    }
    free(neighbours->rules);
    free(neighbours->found);
    free(neighbours->changes);
    free(neighbours);
}

/* ---- Points ---------------------------------------------------------------------------------------------------------- */

static void count_search(struct thread_memory *memory, float radius) {
    if (!(radius >= 0)) return;
    memory->radius_sum += radius < MAX_RADIUS ? radius : MAX_RADIUS;
    memory->searches++;
}

/* Returns the mean radius of the searches. With the maximum, one rule with a long reach would put all points into one cell. */
static float mean_radius(const clk_neighbours *neighbours) {
    double sum = 0;
    int64_t searches = 0;
    for (int32_t i = 0; i < MAX_WORKERS; i++) {
        sum += neighbours->threads[i].radius_sum;
        searches += neighbours->threads[i].searches;
    }
    return searches == 0 ? neighbours->cell : (float)(sum / (double)searches);
}

int32_t clk_neighbours_place(clk_neighbours *neighbours, const clk_point *points, int32_t count, float cell) {
    if (count < 0 || !(cell >= 0)) return CLK_NEIGHBOURS_ARGUMENT;
    for (int32_t i = 0; i < count; i++) {
        if (!isfinite(points[i].x) || !isfinite(points[i].y) || !isfinite(points[i].z)) return CLK_NEIGHBOURS_NOT_FINITE;
        if (points[i].id < 0 || (i > 0 && points[i].id <= points[i - 1].id)) return CLK_NEIGHBOURS_ARGUMENT;
    }
    neighbours->cell = cell > 0 ? cell : mean_radius(neighbours);
    for (int32_t i = 0; i < MAX_WORKERS; i++) {
        neighbours->threads[i].radius_sum = 0;
        neighbours->threads[i].searches = 0;
    }
    return grid_place(&neighbours->grid, points, count, neighbours->cell) ? 0 : CLK_NEIGHBOURS_MEMORY;
}

/* Copies the hits of the calling thread to the memory that the caller reads. */
static int32_t export_hits(clk_neighbours *neighbours, const clk_near **found) {
    const struct hits *hits = &neighbours->threads[0].hits;
    if (!reserve(&neighbours->found, &neighbours->found_capacity, hits->count, sizeof *neighbours->found)) return CLK_NEIGHBOURS_MEMORY;
    for (int32_t i = 0; i < hits->count; i++) {
        int32_t index = hit_index(hits->keys[i]);
        neighbours->found[i] = (clk_near){index, neighbours->grid.points[index].id, hit_distance(hits->keys[i])};
    }
    *found = neighbours->found;
    return hits->count;
}

int32_t clk_neighbours_within(clk_neighbours *neighbours, float x, float y, float z, float inner, float outer, const clk_near **found) {
    struct thread_memory *memory = &neighbours->threads[0];
    float place[3] = {x, y, z};
    count_search(memory, outer);
    if (!grid_within(&neighbours->grid, place, inner, outer, &memory->hits) || !hits_sort(&memory->hits)) return CLK_NEIGHBOURS_MEMORY;
    return export_hits(neighbours, found);
}

int32_t clk_neighbours_nearest(clk_neighbours *neighbours, float x, float y, float z, int32_t limit, float guess, const clk_near **found) {
    if (limit < 0) return CLK_NEIGHBOURS_ARGUMENT;
    struct thread_memory *memory = &neighbours->threads[0];
    float place[3] = {x, y, z};
    float radius = guess > 0 ? guess : mean_radius(neighbours);
    if (!grid_nearest(&neighbours->grid, place, limit, -1, &radius, &memory->hits)) return CLK_NEIGHBOURS_MEMORY;
    count_search(memory, radius);
    return export_hits(neighbours, found);
}

/* ---- Rules ----------------------------------------------------------------------------------------------------------- */

int32_t clk_neighbours_add_rule(clk_neighbours *neighbours) {
    int32_t number = neighbours->free_rule - 1;
    if (number >= 0) {
        neighbours->free_rule = neighbours->rules[number].next_free;
    } else {
        if (!reserve(&neighbours->rules, &neighbours->rule_capacity, (int64_t)neighbours->rule_count + 1, sizeof *neighbours->rules))
            return CLK_NEIGHBOURS_MEMORY;
        number = neighbours->rule_count++;
    }
    neighbours->rules[number] = (struct rule){.next_free = -1};
    return number;
}

static bool is_rule(const clk_neighbours *neighbours, int32_t number) {
    return number >= 0 && number < neighbours->rule_count && neighbours->rules[number].next_free == -1;
}

void clk_neighbours_remove_rule(clk_neighbours *neighbours, int32_t number) {
    if (!is_rule(neighbours, number)) return;
    struct rule *rule = &neighbours->rules[number];
    for (int32_t i = 0; i < rule->count; i++) {
        if (rule->held[i].link >= 0) links_release(&neighbours->links, rule->held[i].link);
    }
    free(rule->held);
    *rule = (struct rule){.next_free = neighbours->free_rule};
    neighbours->free_rule = number + 1;
}

static bool add_change(struct thread_memory *memory, enum change_kind kind, int32_t target, float length, float attenuation) {
    if (!reserve(&memory->changes, &memory->change_capacity, (int64_t)memory->change_count + 1, sizeof *memory->changes)) return false;
    memory->changes[memory->change_count++] = (struct change){kind, target, length, attenuation};
    return true;
}

/* Updates a link that the rule keeps. `unchanged` is the change if the rule keeps its values. */
static bool keep(struct thread_memory *memory, struct held *held, float length, float attenuation, float tolerance,
                 enum change_kind unchanged) {
    bool is_longer = is_beyond(length, held->length, tolerance);
    enum change_kind kind = is_longer || attenuation != held->attenuation ? SET : unchanged;
    if (kind == NONE) return true;
    if (is_longer) held->length = length;
    held->attenuation = attenuation;
    return add_change(memory, kind, held->link, held->length, attenuation);
}

/*
 * Replaces the rule's links with links to `requested`, which is in ascending order of id. Only appends the changes: apply() updates the link table
 * later, so several threads can run this function for different rules.
 */
static bool merge(struct thread_memory *memory, struct rule *rule, const clk_neighbour *requested, int32_t count, float tolerance,
                  bool both, enum change_kind unchanged) {
    struct held *held = rule->held;
    int32_t same = 0;
    /* This loop handles the beginning, because usually most links are the same as before. */
    while (same < count && same < rule->count && held[same].id == requested[same].id) {
        if (!keep(memory, &held[same], requested[same].length, requested[same].attenuation, tolerance, unchanged)) return false;
        same++;
    }
    if (same == count && same == rule->count) return true;
    if (!reserve(&memory->merged, &memory->merged_capacity, count, sizeof *memory->merged)) return false;
    for (int32_t r = same, h = same; r < count || h < rule->count;) {
        if (r == count || (h < rule->count && held[h].id < requested[r].id)) {
            if (!add_change(memory, RELEASE, held[h++].link, 0, 0)) return false;
            continue;
        }
        if (h < rule->count && held[h].id == requested[r].id) {
            if (!keep(memory, &held[h], requested[r].length, requested[r].attenuation, tolerance, unchanged)) return false;
            memory->merged[r] = held[h++];
        } else {
            memory->merged[r] = (struct held){requested[r].id, requested[r].length, requested[r].attenuation, -1};
            if (!add_change(memory, both ? ADD_BOTH : ADD, r, 0, 0)) return false;
        }
        r++;
    }
    if (!reserve(&rule->held, &rule->capacity, count, sizeof *rule->held)) return false;
    if (count > same) memcpy(rule->held + same, memory->merged + same, (size_t)(count - same) * sizeof *rule->held);
    rule->count = count;
    return true;
}

/* Applies the changes of a rule to the link table. `end` is the end of the changes of all rules in the same memory, which limits prefetches. */
static bool apply(clk_neighbours *neighbours, struct rule *rule, const struct change *changes, int32_t count, const struct change *end) {
    struct links *links = &neighbours->links;
    for (int32_t i = 0; i < count; i++) {
        const struct change *change = &changes[i];
        if (end - change > AHEAD && change[AHEAD].kind >= SET) links_prefetch(links, change[AHEAD].target);
        if (change->kind == RELEASE) {
            if (!links_release(links, change->target)) return false;
        } else if (change->kind == REPLACE) {
            if (!links_replace(links, change->target, change->length, change->attenuation)) return false;
        } else if (change->kind == SET) {
            if (!links_set(links, change->target, change->length, change->attenuation)) return false;
        } else {
            struct held *held = &rule->held[change->target];
            held->link = links_add(links, rule->centre, held->id, change->kind == ADD_BOTH, held->length, held->attenuation);
            if (held->link < 0) return false;
        }
    }
    return true;
}

/* Runs a search and merges its results into the links of its rule. */
static bool search(clk_neighbours *neighbours, struct thread_memory *memory, const clk_search *search) {
    const struct grid *grid = &neighbours->grid;
    struct rule *rule = &neighbours->rules[search->rule];
    struct hits *hits = &memory->hits;
    const clk_point *centre = &grid->points[search->centre];
    float place[3] = {centre->x, centre->y, centre->z};
    if (search->nearest < 0) {
        count_search(memory, search->outer);
        if (!grid_within(grid, place, search->inner, search->outer, hits)) return false;
    } else {
        /* The next search probably needs about the same radius as the last one. */
        float radius = rule->reach > 0 ? 1.25f * rule->reach : neighbours->cell;
        if (!grid_nearest(grid, place, search->nearest, search->centre, &radius, hits)) return false;
        count_search(memory, radius);
        rule->reach = hits->count == 0 ? 0 : hit_distance(hits->keys[hits->count - 1]);
    }
    if (!hits_sort(hits)) return false;
    if (!reserve(&memory->requested, &memory->requested_capacity, hits->count, sizeof *memory->requested)) return false;
    int32_t count = 0;
    for (int32_t i = 0; i < hits->count; i++) {
        int32_t index = hit_index(hits->keys[i]);
        memory->requested[count] = (clk_neighbour){grid->points[index].id, hit_distance(hits->keys[i]), 0};
        count += index != search->centre;
    }
    return merge(memory, rule, memory->requested, count, search->tolerance, search->both != 0, neighbours->replaces ? REPLACE : NONE);
}

/* Runs searches until none are left, or until MAX_NEW_LINKS is reached. */
static void run_searches(void *context, int32_t number) {
    clk_neighbours *neighbours = context;
    struct thread_memory *memory = &neighbours->threads[number];
    while (neighbours->new_links < MAX_NEW_LINKS && !neighbours->is_out_of_memory) {
        int32_t first = atomic_fetch_add(&neighbours->next, CHUNK);
        if (first >= neighbours->search_count) return;
        int32_t before = memory->change_count;
        int32_t end = neighbours->search_count - first < CHUNK ? neighbours->search_count : first + CHUNK;
        for (int32_t i = first; i < end; i++) {
            int32_t start = memory->change_count;
            /* The prefetch stays in this chunk, because the next chunk may belong to another thread. */
            if (i + AHEAD < end) __builtin_prefetch(neighbours->rules[neighbours->searches[i + AHEAD].rule].held, 1);
            if (!search(neighbours, memory, &neighbours->searches[i])) neighbours->is_out_of_memory = true;
            neighbours->changes[i] = (struct changes){number, start, memory->change_count - start};
        }
        atomic_fetch_add(&neighbours->new_links, memory->change_count - before);
    }
}

static bool check_searches(clk_neighbours *neighbours, const clk_search *searches, int32_t count) {
    neighbours->update++;
    for (int32_t i = 0; i < count; i++) {
        const clk_search *search = &searches[i];
        if (!is_rule(neighbours, search->rule) || search->nearest < -1) return false;
        if (search->centre < 0 || search->centre >= neighbours->grid.count) return false;
        struct rule *rule = &neighbours->rules[search->rule];
        if (rule->update == neighbours->update) return false;
        rule->update = neighbours->update;
    }
    return true;
}

int32_t clk_neighbours_update(clk_neighbours *neighbours, const clk_search *searches, int32_t count, int32_t threads, int32_t max_links) {
    /* With more searches, the counter that threads increase could overflow. */
    if (count < 0 || count > INT32_MAX / 2 || !check_searches(neighbours, searches, count)) return CLK_NEIGHBOURS_ARGUMENT;
    if (!reserve(&neighbours->changes, &neighbours->changes_capacity, count, sizeof *neighbours->changes)) return CLK_NEIGHBOURS_MEMORY;
    neighbours->searches = searches;
    neighbours->search_count = count;
    neighbours->next = 0;
    neighbours->replaces = neighbours->links.stale > 0;
    for (int32_t done = 0; done < count;) {
        neighbours->new_links = 0;
        for (int32_t i = 0; i < MAX_WORKERS; i++) neighbours->threads[i].change_count = 0;
        workers_run(neighbours->workers, count < MIN_SEARCHES ? 1 : threads, run_searches, neighbours);
        if (neighbours->is_out_of_memory) return CLK_NEIGHBOURS_MEMORY;
        int32_t end = neighbours->next < count ? neighbours->next : count;
        int32_t exceeding = count;
        for (int32_t i = done; i < end; i++) {
            struct changes changes = neighbours->changes[i];
            struct rule *rule = &neighbours->rules[searches[i].rule];
            rule->centre = neighbours->grid.points[searches[i].centre].id;
            const struct thread_memory *memory = &neighbours->threads[changes.thread];
            if (!apply(neighbours, rule, memory->changes + changes.first, changes.count, memory->changes + memory->change_count))
                return CLK_NEIGHBOURS_MEMORY;
            if (neighbours->links.count > max_links && exceeding == count) exceeding = i + 1;
        }
        if (neighbours->links.count > max_links) return exceeding;
        done = end;
    }
    return count;
}

int32_t clk_neighbours_take(clk_neighbours *neighbours, int32_t number, int32_t centre, const clk_neighbour *list, int32_t count,
                            float tolerance, int32_t both) {
    if (!is_rule(neighbours, number) || centre < 0 || count < 0) return CLK_NEIGHBOURS_ARGUMENT;
    for (int32_t i = 0; i < count; i++) {
        if (list[i].id < 0 || list[i].id == centre) return CLK_NEIGHBOURS_ARGUMENT;
    }
    struct thread_memory *memory = &neighbours->threads[0];
    struct hits *order = &memory->hits;
    if (!reserve(&order->keys, &order->capacity, count, sizeof *order->keys)) return CLK_NEIGHBOURS_MEMORY;
    if (!reserve(&memory->requested, &memory->requested_capacity, count, sizeof *memory->requested)) return CLK_NEIGHBOURS_MEMORY;
    for (int32_t i = 0; i < count; i++) order->keys[i] = (uint64_t)(uint32_t)list[i].id << 32 | (uint32_t)i;
    order->count = count;
    if (!hits_sort(order)) return CLK_NEIGHBOURS_MEMORY;
    int32_t requested = 0;
    for (int32_t i = 0; i < count; i++) {
        const clk_neighbour *next = &list[(uint32_t)order->keys[i]];
        if (requested == 0 || memory->requested[requested - 1].id != next->id) memory->requested[requested++] = *next;
    }
    struct rule *rule = &neighbours->rules[number];
    rule->centre = centre;
    memory->change_count = 0;
    if (!merge(memory, rule, memory->requested, requested, tolerance, both != 0, SET)) return CLK_NEIGHBOURS_MEMORY;
    return apply(neighbours, rule, memory->changes, memory->change_count, memory->changes + memory->change_count) ? 0
                                                                                                                  : CLK_NEIGHBOURS_MEMORY;
}

/* ---- Links ----------------------------------------------------------------------------------------------------------- */

int32_t clk_neighbours_hold(clk_neighbours *neighbours, const clk_link *link) {
    if (link->from < 0 || link->to < 0 || link->from == link->to) return CLK_NEIGHBOURS_ARGUMENT;
    return links_hold(&neighbours->links, link) ? 0 : CLK_NEIGHBOURS_MEMORY;
}

int32_t clk_neighbours_release(clk_neighbours *neighbours, int32_t from, int32_t to) {
    int32_t released = links_release_script(&neighbours->links, from, to);
    return released < 0 ? CLK_NEIGHBOURS_MEMORY : released;
}

int32_t clk_neighbours_has(const clk_neighbours *neighbours, int32_t from, int32_t to) { return links_has(&neighbours->links, from, to); }

int32_t clk_neighbours_know(clk_neighbours *neighbours, int32_t id, int32_t known) {
    if (id < 0 || id == INT32_MAX) return CLK_NEIGHBOURS_ARGUMENT;
    return links_know(&neighbours->links, id, known != 0) ? 0 : CLK_NEIGHBOURS_MEMORY;
}

int32_t clk_neighbours_drop(clk_neighbours *neighbours, const int32_t *ids, int32_t count) {
    struct links *links = &neighbours->links;
    for (int32_t i = 0; i < count; i++) {
        if (ids[i] < 0 || ids[i] == INT32_MAX) return CLK_NEIGHBOURS_ARGUMENT;
    }
    if (!links_mark_gone(links, ids, count, true)) return CLK_NEIGHBOURS_MEMORY;
    for (int32_t number = 0; number < neighbours->rule_count; number++) {
        struct rule *rule = &neighbours->rules[number];
        int32_t kept = 0;
        for (int32_t i = 0; i < rule->count && !links_is_gone(links, rule->centre); i++) {
            if (!links_is_gone(links, rule->held[i].id)) rule->held[kept++] = rule->held[i];
        }
        rule->count = kept;
    }
    links_drop_gone(links);
    return links_mark_gone(links, ids, count, false) ? 0 : CLK_NEIGHBOURS_MEMORY;
}

int32_t clk_neighbours_flush(clk_neighbours *neighbours, clk_changes *changes) {
    return links_flush(&neighbours->links, changes) ? 0 : CLK_NEIGHBOURS_MEMORY;
}

void clk_neighbours_pairs(const clk_neighbours *neighbours, clk_pairs *pairs) {
    const struct links *links = &neighbours->links;
    *pairs = (clk_pairs){links->pairs, links->used, links->capacity, links->count};
}
