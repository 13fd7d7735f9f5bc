/* Compares the results of collektive_neighbours with those of brute force. `neighbours_test CASE` runs a case. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "collektive_neighbours.h"

#define CHECK(condition)                                                             \
    do {                                                                             \
        if (!(condition)) {                                                          \
            fprintf(stderr, "%s:%d: %s is false\n", __FILE__, __LINE__, #condition); \
            exit(1);                                                                 \
        }                                                                            \
    } while (0)

/* C# contains copies of these structs, so a change of their layout is a change of the ABI. */
_Static_assert(sizeof(clk_point) == 16 && sizeof(clk_near) == 12 && sizeof(clk_search) == 28, "points and searches");
_Static_assert(sizeof(clk_neighbour) == 12 && sizeof(clk_link) == 16 && sizeof(clk_link_ends) == 8, "links");
_Static_assert(sizeof(clk_changes) == 24 && sizeof(clk_direction) == 16 && sizeof(clk_pair) == 44 && sizeof(clk_pairs) == 24, "pairs");

static uint64_t state;

static uint32_t next_random(void) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(state >> 33);
}

static float uniform(float low, float high) { return low + (high - low) * (float)(next_random() % 1000000) / 1e6f; }

/* The swarms of the tests: on the ground, in space, all at one place, all in one cell, far away, on a line with equal distances, one point, and empty. */
enum swarm { GROUND, SPACE, PLACE, CELL, FAR, LINE, ONE, NONE, SWARMS };
#define MOST 400

static clk_point points[MOST];

static int32_t scatter(enum swarm swarm) {
    int32_t count = swarm == ONE ? 1 : swarm == NONE ? 0 : MOST;
    int32_t id = 0;
    for (int32_t i = 0; i < count; i++) {
        clk_point *point = &points[i];
        *point = (clk_point){uniform(-20, 20), uniform(-1, 1), uniform(-20, 20), id};
        id += 1 + (int32_t)(next_random() % 3);
        if (swarm == SPACE) point->y = uniform(-20, 20);
        if (swarm == PLACE) *point = (clk_point){-7, 3, 5, point->id};
        if (swarm == CELL) *point = (clk_point){uniform(0, 0.1f), uniform(0, 0.1f), uniform(0, 0.1f), point->id};
        if (swarm == FAR) point->x = i % 3 == 0 ? 1e12f : i % 3 == 1 ? -3e38f : 3e38f;
        if (swarm == LINE) *point = (clk_point){(float)(i - MOST / 2), 0, 0, point->id};
    }
    return count;
}

static float distance_between(float x, float y, float z, const clk_point *to) {
    float dx = to->x - x, dy = to->y - y, dz = to->z - z;
    return dx * dx + dy * dy + dz * dz;
}

/* Reference implementation of a search. */
static int32_t scan(float x, float y, float z, float inner, float outer, int32_t count, clk_near *found) {
    int32_t hits = 0;
    for (int32_t i = 0; i < count; i++) {
        float squared = distance_between(x, y, z, &points[i]);
        if (outer >= 0 && inner <= outer && squared <= outer * outer && (inner <= 0 || squared >= inner * inner))
            found[hits++] = (clk_near){i, points[i].id, sqrtf(squared)};
    }
    return hits;
}

static int nearer(const void *left, const void *right) {
    const clk_near *a = left, *b = right;
    if (a->distance != b->distance) return a->distance < b->distance ? -1 : 1;
    return a->index < b->index ? -1 : 1;
}

static const float radii[] = {0, 0.05f, 1, 2.5f, 7, 100, 1e13f, INFINITY, -1, NAN};
enum { RADII = sizeof radii / sizeof *radii };
static const float cells[] = {0, 1e-3f, 1, 3, 50, INFINITY};
enum { CELLS = sizeof cells / sizeof *cells };

static void searches_equal_a_scan(void) {
    clk_neighbours *neighbours = clk_neighbours_create();
    clk_near model[MOST];
    const clk_near *found;
    for (int32_t turn = 0; turn < SWARMS * CELLS; turn++) {
        int32_t count = scatter((enum swarm)(turn % SWARMS));
        CHECK(clk_neighbours_place(neighbours, points, count, cells[turn / SWARMS]) == 0);
        for (int32_t probe = 0; probe < 20 * RADII; probe++) {
            float outer = radii[probe % RADII], inner = probe % 3 == 0 ? 0.5f * outer : probe % 3 == 1 ? 0 : -3;
            float x = uniform(-25, 25), y = uniform(-2, 2), z = uniform(-25, 25);
            if (probe % 2 == 0 && count > 0) {
                const clk_point *at = &points[next_random() % (uint32_t)count];
                x = at->x, y = at->y, z = at->z;
            }
            int32_t expected = scan(x, y, z, inner, outer, count, model);
            CHECK(clk_neighbours_within(neighbours, x, y, z, inner, outer, &found) == expected);
            CHECK(expected == 0 || memcmp(found, model, (size_t)expected * sizeof *model) == 0);
        }
        CHECK(clk_neighbours_within(neighbours, NAN, 0, 0, 0, 1, &found) == 0);
        CHECK(clk_neighbours_within(neighbours, 0, 0, 0, NAN, 1, &found) == 0);
    }
    clk_neighbours_destroy(neighbours);
}

static void nearest_points_equal_a_sorted_scan(void) {
    clk_neighbours *neighbours = clk_neighbours_create();
    clk_near model[MOST];
    const clk_near *found;
    for (int32_t turn = 0; turn < SWARMS * CELLS; turn++) {
        if (turn % SWARMS == FAR) continue; /* tested by nearest_points_are_found_up_to_the_largest_radius */
        int32_t count = scatter((enum swarm)(turn % SWARMS));
        CHECK(clk_neighbours_place(neighbours, points, count, cells[turn / SWARMS]) == 0);
        for (int32_t probe = 0; probe < 100; probe++) {
            float x = uniform(-25, 25), y = uniform(-2, 2), z = uniform(-25, 25);
            int32_t limit = (int32_t[]){0, 1, 2, 8, 50, MOST + 1}[probe % 6];
            float guess = (float[]){0, 1e-5f, 1, 40, INFINITY, NAN, -1}[probe % 7];
            scan(x, y, z, 0, INFINITY, count, model);
            qsort(model, (size_t)count, sizeof *model, nearer);
            int32_t expected = limit < count ? limit : count;
            CHECK(clk_neighbours_nearest(neighbours, x, y, z, limit, guess, &found) == expected);
            CHECK(expected == 0 || memcmp(found, model, (size_t)expected * sizeof *model) == 0);
        }
    }
    clk_neighbours_destroy(neighbours);
}

static void nearest_points_are_found_up_to_the_largest_radius(void) {
    clk_neighbours *neighbours = clk_neighbours_create();
    const clk_near *found;
    clk_point far[] = {{0, 0, 0, 3}, {1e12f, 0, 0, 5}, {3e38f, 0, 0, 8}};
    CHECK(clk_neighbours_place(neighbours, far, 3, 1) == 0);
    CHECK(clk_neighbours_nearest(neighbours, 0, 0, 0, 3, 0, &found) == 2);
    CHECK(found[1].id == 5 && found[1].distance == 1e12f);
    clk_neighbours_destroy(neighbours);
}

static void wrong_arguments_are_refused(void) {
    clk_neighbours *neighbours = clk_neighbours_create();
    const clk_near *found;
    float bad[] = {NAN, INFINITY, -INFINITY};
    clk_point two[] = {{0, 0, 0, 1}, {1, 0, 0, 2}};
    CHECK(clk_neighbours_place(neighbours, two, 2, 1) == 0);
    for (int32_t i = 0; i < 9; i++) {
        clk_point wrong[] = {{0, 0, 0, 1}, {1, 0, 0, 2}};
        *(&wrong[1].x + i % 3) = bad[i / 3];
        CHECK(clk_neighbours_place(neighbours, wrong, 2, 1) == CLK_NEIGHBOURS_NOT_FINITE);
    }
    clk_point equal[] = {{0, 0, 0, 1}, {1, 0, 0, 1}}, negative = {0, 0, 0, -1};
    CHECK(clk_neighbours_place(neighbours, equal, 2, 1) == CLK_NEIGHBOURS_ARGUMENT);
    CHECK(clk_neighbours_place(neighbours, &negative, 1, 1) == CLK_NEIGHBOURS_ARGUMENT);
    CHECK(clk_neighbours_place(neighbours, two, -1, 1) == CLK_NEIGHBOURS_ARGUMENT);
    CHECK(clk_neighbours_place(neighbours, two, 2, NAN) == CLK_NEIGHBOURS_ARGUMENT);
    CHECK(clk_neighbours_within(neighbours, 0, 0, 0, 0, 5, &found) == 2); /* the rejected calls have changed nothing */
    CHECK(clk_neighbours_nearest(neighbours, 0, 0, 0, -1, 5, &found) == CLK_NEIGHBOURS_ARGUMENT);
    int32_t rule = clk_neighbours_add_rule(neighbours);
    clk_search good = {rule, 0, -1, 0, 5, 0, 1};
    clk_search wrong[] = {good, good, good, good, good};
    wrong[0].rule = rule + 1;
    wrong[1].rule = -1;
    wrong[2].centre = 2;
    wrong[3].centre = -1;
    wrong[4].nearest = -2;
    for (int32_t i = 0; i < 5; i++) CHECK(clk_neighbours_update(neighbours, &wrong[i], 1, 1, 99) == CLK_NEIGHBOURS_ARGUMENT);
    clk_search twice[] = {good, good};
    CHECK(clk_neighbours_update(neighbours, twice, 2, 1, 99) == CLK_NEIGHBOURS_ARGUMENT);
    CHECK(clk_neighbours_update(neighbours, &good, -1, 1, 99) == CLK_NEIGHBOURS_ARGUMENT);
    clk_neighbour own = {1, 0, 0}, unknown = {-1, 0, 0};
    CHECK(clk_neighbours_take(neighbours, rule, 1, &own, 1, 0, 1) == CLK_NEIGHBOURS_ARGUMENT);
    CHECK(clk_neighbours_take(neighbours, rule, 1, &unknown, 1, 0, 1) == CLK_NEIGHBOURS_ARGUMENT);
    CHECK(clk_neighbours_hold(neighbours, &(clk_link){1, 1, 0, 0}) == CLK_NEIGHBOURS_ARGUMENT);
    CHECK(clk_neighbours_know(neighbours, -1, 1) == CLK_NEIGHBOURS_ARGUMENT);
    CHECK(clk_neighbours_drop(neighbours, &(int32_t){-1}, 1) == CLK_NEIGHBOURS_ARGUMENT);
    clk_neighbours_remove_rule(neighbours, rule);
    clk_neighbours_remove_rule(neighbours, rule);
    clk_neighbours_remove_rule(neighbours, 77);
    CHECK(clk_neighbours_update(neighbours, &good, 1, 1, 99) == CLK_NEIGHBOURS_ARGUMENT);
    clk_pairs pairs;
    clk_neighbours_pairs(neighbours, &pairs);
    CHECK(pairs.links == 0);
    clk_neighbours_destroy(neighbours);
    clk_neighbours_destroy(NULL);
}

/* ---- Rules and links against a model --------------------------------------------------------------------------------- */

#define IDS 24
#define RULES (2 * IDS)

/* A rule of the model: for each id, whether the rule references the link to it, and whether in both directions. */
static struct model_rule {
    int32_t number, centre;
    bool references[IDS];
    bool both[IDS];
} rules[RULES];
static bool scripts[IDS][IDS], engine[IDS][IDS], known[IDS], present[IDS];
static float engine_length[IDS][IDS], place_of[IDS];

static bool rules_have(int32_t from, int32_t to) {
    for (int32_t i = 0; i < RULES; i++) {
        const struct model_rule *rule = &rules[i];
        if (rule->number < 0) continue;
        if (rule->centre == from && rule->references[to]) return true;
        if (rule->centre == to && rule->references[from] && rule->both[from]) return true;
    }
    return false;
}

static bool model_has(int32_t from, int32_t to) { return scripts[from][to] || rules_have(from, to); }

/* A link that no rule references has the values of the script. */
static void check_direction(const clk_direction *direction, int32_t from, int32_t to) {
    CHECK(direction->references == 0 || model_has(from, to));
    CHECK(direction->references == 0 || rules_have(from, to) || direction->length == 9);
}

static void flush_to_engine(clk_neighbours *neighbours) {
    clk_changes changes;
    CHECK(clk_neighbours_flush(neighbours, &changes) == 0);
    for (int32_t i = 0; i < changes.removed_count; i++) {
        clk_link_ends link = changes.removed[i];
        CHECK(engine[link.from][link.to]); /* only links that were reported before are removed */
        engine[link.from][link.to] = false;
    }
    for (int32_t i = 0; i < changes.set_count; i++) {
        clk_link link = changes.set[i];
        CHECK(known[link.from] && known[link.to]); /* links of unknown ids are not reported yet */
        engine[link.from][link.to] = true;
        engine_length[link.from][link.to] = link.length;
    }
    CHECK(clk_neighbours_flush(neighbours, &changes) == 0);
    CHECK(changes.set_count == 0 && changes.removed_count == 0); /* each change is reported only once */
}

static void drop_id(clk_neighbours *neighbours, int32_t id) {
    CHECK(clk_neighbours_know(neighbours, id, 0) == 0);
    CHECK(clk_neighbours_drop(neighbours, &id, 1) == 0);
    known[id] = false;
    for (int32_t other = 0; other < IDS; other++) {
        engine[id][other] = engine[other][id] = scripts[id][other] = scripts[other][id] = false;
        for (int32_t r = 0; r < RULES; r++) {
            rules[r].references[id] = false;
            if (rules[r].centre == id) rules[r].references[other] = false;
        }
    }
}

static int32_t place_present(clk_neighbours *neighbours, int32_t *index_of) {
    clk_point now[IDS];
    int32_t count = 0;
    for (int32_t id = 0; id < IDS; id++) {
        index_of[id] = count;
        if (present[id]) now[count++] = (clk_point){place_of[id], 0, 0, id};
    }
    CHECK(clk_neighbours_place(neighbours, now, count, 0) == 0);
    return count;
}

static void update_all(clk_neighbours *neighbours) {
    clk_search searches[RULES];
    int32_t index_of[IDS], count = 0;
    place_present(neighbours, index_of);
    for (int32_t r = 0; r < RULES; r++) {
        struct model_rule *rule = &rules[r];
        if (rule->number < 0 || !present[rule->centre]) continue;
        float outer = uniform(0, 3);
        bool both = r % 4 != 0;
        searches[count++] = (clk_search){rule->number, index_of[rule->centre], -1, 0, outer, 0, both};
        for (int32_t id = 0; id < IDS; id++) {
            float way = place_of[id] - place_of[rule->centre];
            bool now = present[id] && id != rule->centre && way * way <= outer * outer;
            if (now && !rule->references[id]) rule->both[id] = both;
            rule->references[id] = now;
        }
    }
    CHECK(clk_neighbours_update(neighbours, searches, count, 1, 9999) == count);
}

static void take_one(clk_neighbours *neighbours, struct model_rule *rule) {
    clk_neighbour list[2 * IDS];
    int32_t count = 0;
    bool both = next_random() % 2 == 0;
    bool now[IDS] = {false};
    for (int32_t i = 0; i < 2 * IDS; i++) {
        int32_t id = (int32_t)(next_random() % IDS);
        if (id == rule->centre || next_random() % 3 > 0) continue;
        list[count++] = (clk_neighbour){id, now[id] ? 77.0f : 5.0f, 0}; /* of neighbours with the same id, the first counts */
        now[id] = true;
    }
    CHECK(clk_neighbours_take(neighbours, rule->number, rule->centre, list, count, 0, both) == 0);
    for (int32_t id = 0; id < IDS; id++) {
        if (now[id] && !rule->references[id]) rule->both[id] = both;
        rule->references[id] = now[id];
    }
}

static void check_links(clk_neighbours *neighbours) {
    int32_t links = 0;
    for (int32_t from = 0; from < IDS; from++) {
        for (int32_t to = 0; to < IDS; to++) {
            if (from == to) continue;
            CHECK(clk_neighbours_has(neighbours, from, to) == model_has(from, to));
            links += model_has(from, to);
        }
    }
    clk_pairs pairs;
    clk_neighbours_pairs(neighbours, &pairs);
    CHECK(pairs.links == links && pairs.count <= pairs.capacity);
    for (int32_t i = 0; i < pairs.count; i++) {
        const clk_pair *pair = &pairs.pairs[i];
        links -= (pair->up.references > 0) + (pair->down.references > 0);
        check_direction(&pair->up, pair->low, pair->high);
        check_direction(&pair->down, pair->high, pair->low);
    }
    CHECK(links == 0);
}

static void links_exist_while_referenced_and_changes_are_sent_once(void) {
    for (int32_t run = 0; run < 20; run++) {
        clk_neighbours *neighbours = clk_neighbours_create();
        memset(scripts, 0, sizeof scripts);
        memset(engine, 0, sizeof engine);
        for (int32_t id = 0; id < IDS; id++) {
            known[id] = id % 3 != 0;
            present[id] = true;
            place_of[id] = uniform(0, 10);
            if (known[id]) CHECK(clk_neighbours_know(neighbours, id, 1) == 0);
        }
        for (int32_t r = 0; r < RULES; r++) rules[r] = (struct model_rule){clk_neighbours_add_rule(neighbours), r % IDS, {false}, {false}};
        for (int32_t step = 0; step < 400; step++) {
            int32_t from = (int32_t)(next_random() % IDS), to = (int32_t)(next_random() % IDS), r = (int32_t)(next_random() % RULES);
            switch (next_random() % 8) {
                case 0:
                    if (from == to) break;
                    CHECK(clk_neighbours_hold(neighbours, &(clk_link){from, to, 9, 0}) == 0);
                    scripts[from][to] = true;
                    break;
                case 1:
                    CHECK(clk_neighbours_release(neighbours, from, to) == scripts[from][to]);
                    scripts[from][to] = false;
                    break;
                case 2:
                    clk_neighbours_remove_rule(neighbours, rules[r].number);
                    rules[r] = (struct model_rule){clk_neighbours_add_rule(neighbours), rules[r].centre, {false}, {false}};
                    break;
                case 3:
                    drop_id(neighbours, from);
                    present[from] = next_random() % 2 == 0; /* the node has left, or has left and come back */
                    break;
                case 4:
                    present[from] = known[from] = true;
                    CHECK(clk_neighbours_know(neighbours, from, 1) == 0);
                    place_of[from] = uniform(0, 10);
                    flush_to_engine(neighbours);
                    break;
                case 5: take_one(neighbours, &rules[r]); break;
                default:
                    for (int32_t id = 0; id < IDS; id++) place_of[id] += uniform(-0.3f, 0.3f);
                    update_all(neighbours);
            }
            check_links(neighbours);
        }
        for (int32_t id = 0; id < IDS; id++) {
            known[id] = true;
            CHECK(clk_neighbours_know(neighbours, id, 1) == 0);
        }
        flush_to_engine(neighbours);
        for (int32_t from = 0; from < IDS; from++) {
            for (int32_t to = 0; to < IDS; to++) CHECK(from == to || engine[from][to] == model_has(from, to));
        }
        clk_neighbours_destroy(neighbours);
    }
}

static void lengths_are_sent_when_they_leave_the_tolerance(void) {
    clk_neighbours *neighbours = clk_neighbours_create();
    clk_changes changes;
    int32_t rule = clk_neighbours_add_rule(neighbours);
    CHECK(clk_neighbours_know(neighbours, 4, 1) == 0 && clk_neighbours_know(neighbours, 9, 1) == 0);
    float places[] = {1, 1.25f, 1.5f, 1.0f, 1.26f, 5, 1};
    float sent[] = {1, 0, 1.5f, 1.0f, 1.26f, 0, 1};
    for (int32_t i = 0; i < 7; i++) {
        clk_point now[] = {{0, 0, 0, 4}, {0, 0, places[i], 9}};
        CHECK(clk_neighbours_place(neighbours, now, 2, 0) == 0);
        CHECK(clk_neighbours_update(neighbours, &(clk_search){rule, 0, -1, 0, 3, 0.25f, 1}, 1, 1, 99) == 1);
        CHECK(clk_neighbours_flush(neighbours, &changes) == 0);
        CHECK(changes.set_count == (sent[i] > 0 ? 2 : 0) && changes.removed_count == (places[i] > 3 ? 2 : 0));
        if (changes.set_count > 0) CHECK(changes.set[0].from == 4 && changes.set[1].from == 9 && changes.set[1].length == sent[i]);
    }
    CHECK(clk_neighbours_take(neighbours, rule, 4, &(clk_neighbour){9, 1.1f, 2}, 1, 0.25f, 1) == 0);
    CHECK(clk_neighbours_flush(neighbours, &changes) == 0);
    CHECK(changes.set_count == 2 && changes.set[0].length == 1 && changes.set[0].attenuation == 2);
    clk_neighbours_destroy(neighbours);
}

static void rules_of_the_caller_determine_the_values_of_shared_links(void) {
    clk_neighbours *neighbours = clk_neighbours_create();
    clk_changes changes;
    int32_t search = clk_neighbours_add_rule(neighbours), taken = clk_neighbours_add_rule(neighbours);
    CHECK(clk_neighbours_know(neighbours, 4, 1) == 0 && clk_neighbours_know(neighbours, 9, 1) == 0);
    float places[] = {1, 2, 2, 2.2f, 2.2f, 2.2f};
    float attenuations[] = {5, 5, 5, 5, 0, 0};
    float sent[] = {1, 2, 0, 0, 2, 0};
    for (int32_t i = 0; i < 6; i++) {
        clk_point now[] = {{0, 0, 0, 4}, {0, 0, places[i], 9}};
        CHECK(clk_neighbours_place(neighbours, now, 2, 0) == 0);
        if (i == 4) clk_neighbours_remove_rule(neighbours, taken);
        CHECK(clk_neighbours_update(neighbours, &(clk_search){search, 0, -1, 0, 3, 0.25f, 1}, 1, 1, 99) == 1);
        if (i < 4) CHECK(clk_neighbours_take(neighbours, taken, 4, &(clk_neighbour){9, places[i], 5}, 1, 0.25f, 1) == 0);
        CHECK(clk_neighbours_flush(neighbours, &changes) == 0);
        CHECK(changes.set_count == (sent[i] > 0 ? 2 : 0));
        if (sent[i] > 0) CHECK(changes.set[1].length == sent[i] && changes.set[1].attenuation == attenuations[i]);
    }
    clk_neighbours_destroy(neighbours);
}

static void values_of_released_links_are_those_of_the_remaining_rules(void) {
    clk_neighbours *neighbours = clk_neighbours_create();
    clk_changes changes;
    int32_t wide = clk_neighbours_add_rule(neighbours), narrow = clk_neighbours_add_rule(neighbours),
            taken = clk_neighbours_add_rule(neighbours);
    CHECK(clk_neighbours_know(neighbours, 4, 1) == 0 && clk_neighbours_know(neighbours, 9, 1) == 0);
    float places[] = {6.735f, 5.235f, 4.995f, 5.2f, 5.4f, 5.4f, 5.4f, 5.4f, 5.6f, 5.6f, 5.6f};
    float sent[] = {6.735f, 5.235f, 4.995f, 0, 5.235f, 0, 5.0f, 0, 5.0f, 0, 5.6f};
    for (int32_t i = 0; i < 11; i++) {
        clk_point now[] = {{0, 0, 0, 4}, {0, 0, places[i], 9}};
        clk_search searches[] = {{wide, 0, -1, 0, 8, 0.25f, 1}, {narrow, 1, -1, 0, 5, 0.25f, 1}};
        clk_neighbour cable = {9, 5, 0};
        CHECK(clk_neighbours_place(neighbours, now, 2, 0) == 0);
        CHECK(clk_neighbours_update(neighbours, searches, 2, 1, 99) == 2);
        CHECK(i < 6 || clk_neighbours_take(neighbours, taken, 4, &cable, i < 9, 0.25f, 1) == 0);
        CHECK(clk_neighbours_flush(neighbours, &changes) == 0);
        CHECK(changes.set_count == (sent[i] > 0 ? 2 : 0));
        if (sent[i] > 0) CHECK(changes.set[0].length == sent[i] && changes.set[1].length == sent[i]);
    }
    clk_neighbours_destroy(neighbours);
}

static void rules_of_the_caller_replace_the_values_of_scripts(void) {
    clk_neighbours *neighbours = clk_neighbours_create();
    clk_changes changes;
    int32_t rule = clk_neighbours_add_rule(neighbours);
    CHECK(clk_neighbours_know(neighbours, 4, 1) == 0 && clk_neighbours_know(neighbours, 9, 1) == 0);
    for (int32_t i = 0; i < 2; i++) {
        CHECK(clk_neighbours_take(neighbours, rule, 4, &(clk_neighbour){9, 4, 0}, 1, 0.25f, 0) == 0);
        CHECK(clk_neighbours_hold(neighbours, &(clk_link){4, 9, 4.4f, 0}) == 0);
    }
    CHECK(clk_neighbours_flush(neighbours, &changes) == 0);
    CHECK(changes.set_count == 1 && changes.set[0].length == 4);
    clk_neighbours_destroy(neighbours);
}

/* Returns the size of this process's address space in bytes, or 0 on systems without /proc. */
static uint64_t memory_used(void) {
    unsigned long long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file == NULL) return 0;
    if (fscanf(file, "%llu", &pages) != 1) pages = 0;
    fclose(file);
    return pages * 4096;
}

/* An array that has an element for each id would need gigabytes. */
static void links_between_the_largest_ids_need_little_memory(void) {
    int32_t last = INT32_MAX - 1;
    clk_neighbours *neighbours = clk_neighbours_create();
    clk_changes changes;
    uint64_t before = memory_used();
    CHECK(clk_neighbours_know(neighbours, 0, 1) == 0 && clk_neighbours_know(neighbours, last, 1) == 0);
    CHECK(clk_neighbours_hold(neighbours, &(clk_link){last, 0, 2, 0}) == 0);
    CHECK(clk_neighbours_flush(neighbours, &changes) == 0 && changes.set_count == 1 && changes.set[0].from == last);
    CHECK(clk_neighbours_drop(neighbours, &last, 1) == 0 && !clk_neighbours_has(neighbours, last, 0));
    CHECK(memory_used() - before < (64u << 20));
    clk_neighbours_destroy(neighbours);
}

/* ---- Swarms ---------------------------------------------------------------------------------------------------------- */

struct swarm_of {
    clk_neighbours *neighbours;
    clk_point *points;
    float (*ways)[2];
    clk_search *searches;
    int32_t count;
    float side;
};

static struct swarm_of make_swarm(int32_t count, float spacing, float radius) {
    state = 42;
    size_t length = (size_t)count;
    struct swarm_of swarm = {clk_neighbours_create(),
                             calloc(length, sizeof(clk_point)),
                             calloc(length, sizeof(float[2])),
                             calloc(length, sizeof(clk_search)),
                             count,
                             spacing * sqrtf((float)count)};
    CHECK(swarm.neighbours && swarm.points && swarm.ways && swarm.searches);
    for (int32_t i = 0; i < count; i++) {
        swarm.points[i] = (clk_point){uniform(0, swarm.side), 0, uniform(0, swarm.side), i};
        float angle = uniform(0, 6.283185f);
        swarm.ways[i][0] = 0.1f * cosf(angle);
        swarm.ways[i][1] = 0.1f * sinf(angle);
        /* With radius 0, a third of the rules search for nearest points, a third in a band, and a third within a distance. */
        swarm.searches[i] = (clk_search){clk_neighbours_add_rule(swarm.neighbours),
                                         i,
                                         radius > 0   ? -1
                                         : i % 3 == 0 ? 6
                                                      : -1,
                                         radius <= 0 && i % 3 == 1 ? 1.0f : 0,
                                         radius > 0 ? radius : 2.5f,
                                         0.25f,
                                         i % 5 > 0};
        CHECK(clk_neighbours_know(swarm.neighbours, i, 1) == 0);
    }
    return swarm;
}

static void move_swarm(struct swarm_of *swarm) {
    for (int32_t i = 0; i < swarm->count; i++) {
        clk_point *point = &swarm->points[i];
        point->x += swarm->ways[i][0];
        point->z += swarm->ways[i][1];
        if (point->x < 0 || point->x > swarm->side) swarm->ways[i][0] = -swarm->ways[i][0];
        if (point->z < 0 || point->z > swarm->side) swarm->ways[i][1] = -swarm->ways[i][1];
    }
}

static void free_swarm(struct swarm_of *swarm) {
    clk_neighbours_destroy(swarm->neighbours);
    free(swarm->points);
    free(swarm->ways);
    free(swarm->searches);
}

static void any_number_of_threads_has_equal_results(void) {
    int32_t threads[] = {1, 2, 4, 99};
    struct swarm_of swarms[4];
    clk_changes changes[4];
    for (int32_t i = 0; i < 4; i++) swarms[i] = make_swarm(3000, 1, 0);
    for (int32_t tick = 0; tick < 60; tick++) {
        for (int32_t i = 0; i < 4; i++) {
            struct swarm_of *swarm = &swarms[i];
            move_swarm(swarm);
            CHECK(clk_neighbours_place(swarm->neighbours, swarm->points, swarm->count, 0) == 0);
            CHECK(clk_neighbours_update(swarm->neighbours, swarm->searches, swarm->count, threads[i], 1 << 24) == swarm->count);
            CHECK(clk_neighbours_flush(swarm->neighbours, &changes[i]) == 0);
            CHECK(changes[i].set_count == changes[0].set_count && changes[i].removed_count == changes[0].removed_count);
            CHECK(memcmp(changes[i].set, changes[0].set, (size_t)changes[0].set_count * sizeof(clk_link)) == 0);
            CHECK(memcmp(changes[i].removed, changes[0].removed, (size_t)changes[0].removed_count * sizeof(clk_link_ends)) == 0);
        }
        CHECK(changes[0].set_count > 100);
    }
    for (int32_t i = 0; i < 4; i++) free_swarm(&swarms[i]);
}

static void an_update_stops_at_the_limit_of_links(void) {
    for (int32_t threads = 1; threads <= 2; threads++) {
        struct swarm_of swarm = make_swarm(3000, 0, 1); /* all points coincide, so all are neighbours */
        CHECK(clk_neighbours_place(swarm.neighbours, swarm.points, swarm.count, 0) == 0);
        int32_t done = clk_neighbours_update(swarm.neighbours, swarm.searches, swarm.count, threads, 1000000);
        clk_pairs pairs;
        clk_neighbours_pairs(swarm.neighbours, &pairs);
        CHECK(done > 150 && done < 500);
        CHECK(pairs.links > 1000000 && pairs.links < 3000000);
        for (int32_t i = 0; i < swarm.count; i++) clk_neighbours_remove_rule(swarm.neighbours, swarm.searches[i].rule);
        clk_neighbours_pairs(swarm.neighbours, &pairs);
        CHECK(pairs.links == 0);
        free_swarm(&swarm);
    }
}

int main(int count, char **words) {
    static const struct {
        const char *name;
        void (*run)(void);
    } cases[] = {
#define CASE(name) {#name, name}
        CASE(searches_equal_a_scan),
        CASE(nearest_points_equal_a_sorted_scan),
        CASE(nearest_points_are_found_up_to_the_largest_radius),
        CASE(wrong_arguments_are_refused),
        CASE(links_exist_while_referenced_and_changes_are_sent_once),
        CASE(lengths_are_sent_when_they_leave_the_tolerance),
        CASE(rules_of_the_caller_determine_the_values_of_shared_links),
        CASE(values_of_released_links_are_those_of_the_remaining_rules),
        CASE(rules_of_the_caller_replace_the_values_of_scripts),
        CASE(links_between_the_largest_ids_need_little_memory),
        CASE(any_number_of_threads_has_equal_results),
        CASE(an_update_stops_at_the_limit_of_links),
    };
    for (size_t i = 0; count == 2 && i < sizeof cases / sizeof *cases; i++) {
        if (strcmp(words[1], cases[i].name) != 0) continue;
        state = 1;
        cases[i].run();
        return 0;
    }
    fprintf(stderr, "usage: neighbours_test CASE\n");
    return 2;
}
