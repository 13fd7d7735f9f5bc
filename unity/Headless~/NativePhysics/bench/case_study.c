/*
 * The case study as bare loops: PhysX, the neighbour search, and hand-written sensors, rounds and actuators on arrays. `bench scene` compares the player
 * with this program.
 *
 * `case_study NODES THREADS TICKS WARM_UP` prints the mean times of the ticks after the warm-up in milliseconds, and the mean distance to the source at
 * the end in metres, which shows that the swarm does what the sample's swarm does. The scene is the one of GradientAscentScene.cs at the same density; the
 * positions at the start are other random ones. PhysX, the searches and the queries use all threads, and the other loops one.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "collektive_neighbours.h"
#include "collektive_physics.h"
#include "prim.h"

enum { SENSE, RULES, ROUNDS, ACT, PHYSICS, PHASES };
static const char *const PHASE_NAMES[PHASES] = {"sense_ms", "rules_ms", "rounds_ms", "act_ms", "physics_ms"};

enum { IGNORE_RAYCAST_LAYER = 2, NODES_OF_FIELD = 500, MAX_HITS = 16, STEPS = 3 };
static const float DELTA_TIME = 0.05f, RANGE = 3, REACH = 1, RADIUS = 0.25f, MAX_SPEED = 5, REACH_TIME = 0.5f, TOO_SMALL = 1e-6f;

typedef struct {
    float x, z, intensity; /* the message of a node to its neighbours */
} sample;

static void require(int condition, const char *what) {
    if (condition) return;
    fprintf(stderr, "case_study: %s failed: %s\n", what, physics_error());
    exit(1);
}

static void *allocate(int32_t count, size_t size) {
    void *memory = calloc((size_t)count, size);
    require(memory != NULL, "an allocation");
    return memory;
}

static float uniform(float low, float high) {
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (float)(state >> 40) / (float)(1 << 24);
}

static double now_ms(void) { return 1e-6 * (double)prim_now(); }

/* Adds a shape to an actor, and returns its handle. */
static int32_t add_shape(physics_world *world, int32_t actor, physics_geometry geometry, int32_t layer) {
    static uint32_t identity;
    physics_shape shape = {
        .geometry = geometry, .pose.rotation.w = 1, .material.friction_combine = PHYSICS_MINIMUM, .identity = ++identity, .layer = layer};
    int32_t handle = physics_shape_create(world, actor, &shape);
    require(handle != PHYSICS_NONE, "the creation of a shape");
    return handle;
}

static void add_box(physics_world *world, float x, float y, float z, float size_x, float size_y, float size_z, int32_t layer) {
    int32_t actor = physics_actor_create(world, PHYSICS_STATIC, &(physics_pose){{x, y, z}, {0, 0, 0, 1}});
    add_shape(world, actor, (physics_geometry){.kind = PHYSICS_BOX, .half = {size_x / 2, size_y / 2, size_z / 2}}, layer);
}

static void add_field(physics_world *world, float scale) {
    float length = 100 * scale, width = 60 * scale;
    add_box(world, 0, -0.5f, 0, length, 1, width, IGNORE_RAYCAST_LAYER);
    for (float side = -1; side <= 1; side += 2) {
        add_box(world, 0, 0.5f, side * (width / 2 + 0.25f), length + 1, 1, 0.5f, 0);
        add_box(world, side * (length / 2 + 0.25f), 0.5f, 0, 0.5f, 1, width, 0);
    }
    for (float place = -9; place <= 9; place += 6) add_box(world, 10 * scale, 1.5f, place * scale, 1, 3, 5 * scale, 0);
}

int main(int argument_count, char **arguments) {
    int32_t numbers[4];
    require(argument_count == 5, "usage: case_study NODES THREADS TICKS WARM_UP;");
    for (int32_t i = 0; i < 4; i++) numbers[i] = (int32_t)strtol(arguments[i + 1], NULL, 10);
    int32_t count = numbers[0], threads = numbers[1], ticks = numbers[2], warm_up = numbers[3];
    require(count > 0 && threads > 0 && warm_up >= 0 && ticks > warm_up, "usage: case_study NODES THREADS TICKS WARM_UP;");

    float scale = sqrtf((float)count / NODES_OF_FIELD), source_x = 25 * scale;
    physics_world *world = physics_world_create(threads);
    clk_neighbours *neighbours = clk_neighbours_create();
    require(world != NULL && neighbours != NULL, "the creation of the world");
    add_field(world, scale);

    int32_t *actors = allocate(count, sizeof *actors), *node_of_shape = allocate(count + 64, sizeof *node_of_shape);
    int32_t *hits = allocate(count * MAX_HITS, sizeof *hits);
    clk_point *points = allocate(count, sizeof *points);
    clk_search *searches = allocate(count, sizeof *searches);
    physics_motion *motions = allocate(count + 64, sizeof *motions);
    physics_command *commands = allocate(count, sizeof *commands);
    physics_sphere *spheres = allocate(count, sizeof *spheres);
    physics_filter *filters = allocate(count, sizeof *filters);
    sample *samples = allocate(count, sizeof *samples), *sent = allocate(count, sizeof *sent);
    float (*pulls)[2] = allocate(count, sizeof *pulls);
    memset(node_of_shape, -1, (size_t)(count + 64) * sizeof *node_of_shape);

    for (int32_t i = 0; i < count; i++) {
        points[i] = (clk_point){uniform(-35 * scale, 5 * scale), RADIUS, uniform(-25 * scale, 25 * scale), i};
        physics_pose pose = {{points[i].x, points[i].y, points[i].z}, {0, 0, 0, 1}};
        actors[i] = physics_actor_create(world, PHYSICS_DYNAMIC, &pose);
        require(actors[i] >= 0 && actors[i] < count + 64, "the creation of a body");
        int32_t shape = add_shape(world, actors[i], (physics_geometry){.kind = PHYSICS_SPHERE, .radius = RADIUS}, 0);
        require(shape < count + 64, "the numbering of shapes");
        node_of_shape[shape] = i;
        motions[actors[i]].pose = pose;
        /* bits 3 to 5: no rotations */
        commands[i] = (physics_command){.actor = actors[i], .kind = PHYSICS_FREEZE, .value = {56}};
        searches[i] = (clk_search){clk_neighbours_add_rule(neighbours), i, -1, 0, RANGE, 0.25f, 0};
        require(clk_neighbours_know(neighbours, i, 1) == 0, "the registration of a node");
        filters[i] = (physics_filter){~(1u << IGNORE_RAYCAST_LAYER), 0, 0};
    }
    physics_apply(world, commands, count);

    double sums[PHASES] = {0};
    for (int32_t tick = 0; tick < ticks; tick++) {
        double times[PHASES + 1];
        times[SENSE] = now_ms();
        for (int32_t i = 0; i < count; i++) {
            physics_vector at = motions[actors[i]].pose.position;
            points[i] = (clk_point){at.x, at.y, at.z, i};
            spheres[i] = (physics_sphere){at, REACH};
        }
        physics_begin_overlaps(world, spheres, filters, count, hits, MAX_HITS);
        for (int32_t i = 0; i < count; i++) {
            float x = points[i].x - source_x, z = points[i].z;
            float intensity = 100 - sqrtf(x * x + points[i].y * points[i].y + z * z) / scale;
            samples[i] = (sample){points[i].x, points[i].z, intensity > 0 ? intensity : 0};
        }
        physics_finish_overlaps(world);
        for (int32_t i = 0; i < count; i++) {
            pulls[i][0] = pulls[i][1] = 0;
            for (int32_t hit = 0; hit < MAX_HITS && hits[i * MAX_HITS + hit] != PHYSICS_NONE; hit++) {
                int32_t shape = hits[i * MAX_HITS + hit], node = node_of_shape[shape];
                if (node == i) continue;
                physics_vector here = {points[i].x, points[i].y, points[i].z}, closest = here;
                float nearer = 1;
                if (node < 0)
                    physics_closest_point(world, shape, NULL, &here, &closest);
                else
                    closest = (physics_vector){points[node].x, points[node].y, points[node].z};
                float x = closest.x - here.x, y = closest.y - here.y, z = closest.z - here.z, distance = sqrtf(x * x + y * y + z * z);
                if (node >= 0 && distance > RADIUS) nearer = (distance - RADIUS) / distance;
                distance *= nearer;
                if (distance < TOO_SMALL || distance > REACH) continue;
                float push = 2 * nearer / (distance * distance * distance);
                pulls[i][0] -= push * x;
                pulls[i][1] -= push * z;
            }
        }
        times[RULES] = now_ms();
        clk_changes changes;
        require(clk_neighbours_place(neighbours, points, count, 0) == 0, "the placement of nodes");
        require(clk_neighbours_update(neighbours, searches, count, threads, 1 << 24) == count, "the search for neighbours");
        require(clk_neighbours_flush(neighbours, &changes) == 0, "the count of links");
        times[ROUNDS] = now_ms();
        clk_pairs pairs;
        clk_neighbours_pairs(neighbours, &pairs);
        /* Both directions of a pair have links, because all nodes have the same range. A node reads what its neighbours sent in the last tick. */
        for (int32_t i = 0; i < pairs.count && tick > 0; i++) {
            const clk_pair *pair = &pairs.pairs[i];
            if (pair->up.references == 0) continue;
            for (int32_t end = 0; end < 2; end++) {
                int32_t node = end == 0 ? pair->low : pair->high;
                const sample *here = &samples[node], *there = &sent[end == 0 ? pair->high : pair->low];
                float x = there->x - here->x, z = there->z - here->z, distance = sqrtf(x * x + z * z);
                if (distance < TOO_SMALL) continue;
                float pull = (there->intensity - here->intensity) / distance;
                pulls[node][0] += pull * x;
                pulls[node][1] += pull * z;
            }
        }
        sample *swap = sent;
        sent = samples;
        samples = swap;
        times[ACT] = now_ms();
        for (int32_t i = 0; i < count; i++) {
            float length = sqrtf(pulls[i][0] * pulls[i][0] + pulls[i][1] * pulls[i][1]);
            float speed = length < TOO_SMALL ? 0 : fminf(1 / REACH_TIME, MAX_SPEED) / length;
            commands[i] = (physics_command){.actor = actors[i],
                                            .kind = PHYSICS_VELOCITY,
                                            .value = {speed * pulls[i][0], motions[actors[i]].velocity.y, speed * pulls[i][1]}};
        }
        times[PHYSICS] = now_ms();
        for (int32_t step = 0; step < STEPS; step++) {
            physics_result result;
            require(physics_step(world, commands, step == 0 ? count : 0, DELTA_TIME / STEPS, &(physics_vector){0, -9.81f, 0},
                                 tick * STEPS + step + 1, motions, &result),
                    "a step");
        }
        times[PHASES] = now_ms();
        for (int32_t phase = 0; phase < PHASES && tick >= warm_up; phase++) sums[phase] += times[phase + 1] - times[phase];
    }

    double distance = 0;
    for (int32_t i = 0; i < count; i++) {
        physics_vector at = motions[actors[i]].pose.position;
        distance += hypot((double)(at.x - source_x), (double)at.z) / count;
    }
    printf("{");
    for (int32_t phase = 0; phase < PHASES; phase++) printf("\"%s\": %.4f, ", PHASE_NAMES[phase], sums[phase] / (ticks - warm_up));
    printf("\"mean_distance\": %.2f}\n", distance);
    clk_neighbours_destroy(neighbours);
    physics_world_destroy(world);
    return 0;
}
