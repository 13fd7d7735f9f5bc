/*
 * collektive_physics: the physics of the headless player, PhysX behind a C interface.
 *
 * A world contains actors (bodies and positions of static colliders) and their shapes. State is exchanged in blocks: the caller fills an array of
  * commands, physics_step applies it, moves the world and returns arrays of motions and touches. In steady state no calls per body are needed.
 *
 * Units are metres, seconds, kilograms and radians; quaternions are x, y, z, w.
 * Threads: one thread at a time may call into a world. physics_step and queries of several rays use the world's worker threads during the call,
  * queries of several spheres use them between two calls.
 * Determinism: the same calls give the same bits, for any number of threads, on every start of the same build.
 * Ownership: the caller owns its arguments. Results of physics_step belong to the world and are valid until the next step.
 * Handles are small numbers that are reused after their destruction. A call with a dead handle is ignored, or returns PHYSICS_NONE or 0.
 */
#ifndef COLLEKTIVE_PHYSICS_H
#define COLLEKTIVE_PHYSICS_H

#include <stdint.h>

#ifdef COLLEKTIVE_PHYSICS_BUILD
#define PHYSICS_API __attribute__((visibility("default")))
#else
#define PHYSICS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define PHYSICS_VERSION 7
#define PHYSICS_NONE (-1)
#define PHYSICS_BACK_FACES 1
#define PHYSICS_ALL_FACES 2

typedef struct physics_world physics_world;
typedef struct physics_mesh physics_mesh;

typedef struct {
    float x, y, z;
} physics_vector;
typedef struct {
    float x, y, z, w;
} physics_quaternion;
typedef struct {
    physics_vector position;
    physics_quaternion rotation;
} physics_pose;

/* The PHYSICS_VERSION that the library was built with. */
PHYSICS_API int32_t physics_version(void);

/* Returns the first error since the last call, or an empty string. It belongs to the library and is valid until the next call into it. */
PHYSICS_API const char *physics_error(void);

/* ---- Worlds ---- */

/* Creates an empty world that uses `threads` threads (1 or more, including the calling one). Returns NULL if out of memory. */
PHYSICS_API physics_world *physics_world_create(int32_t threads);

/* Frees the world and its actors, but not meshes. */
PHYSICS_API void physics_world_destroy(physics_world *world);

/* Pairs of layers that pass through each other: bit j of row i for the layers i and j. The matrix is symmetric. */
PHYSICS_API void physics_ignore_layers(physics_world *world, const uint32_t rows[32]);

/* Sets whether the shapes with these identities pass through each other. It also applies to later shapes with the same identities.
 * Handles of shapes that do not exist are PHYSICS_NONE. */
PHYSICS_API void physics_ignore_pair(physics_world *world, uint32_t identity, uint32_t other, int32_t shape, int32_t other_shape,
                                     int32_t ignore);

/* Sets whether the total friction of a contact is at most its normal force times the coefficient. By default, friction between
 * surfaces that touch at several points can be twice as strong. */
PHYSICS_API void physics_improve_friction(physics_world *world, int32_t improved);

/* ---- Actors ---- */

enum { PHYSICS_STATIC = 0, PHYSICS_DYNAMIC = 1 };

/* Creates an actor. A dynamic one has mass 1, gravity on, linear damping 0, angular damping 0.05, Unity's other defaults, and is awake. */
PHYSICS_API int32_t physics_actor_create(physics_world *world, int32_t kind, const physics_pose *pose);

/* Removes an actor with its shapes. Its touches end without reports. */
PHYSICS_API void physics_actor_destroy(physics_world *world, int32_t actor);

/* The centre of mass in the actor's frame. */
PHYSICS_API void physics_mass_center(physics_world *world, int32_t actor, physics_vector *center);

/* The inertia tensor (kg m2) about the centre of mass, as the diagonal in a frame rotated by `rotation` relative to the actor's. */
PHYSICS_API void physics_inertia(physics_world *world, int32_t actor, physics_vector *diagonal, physics_quaternion *rotation);

/* ---- Shapes ---- */

enum { PHYSICS_SPHERE = 0, PHYSICS_BOX = 1, PHYSICS_CAPSULE = 2, PHYSICS_MESH = 3 };
enum { PHYSICS_AVERAGE = 0, PHYSICS_MINIMUM = 1, PHYSICS_MULTIPLY = 2, PHYSICS_MAXIMUM = 3 };
enum { PHYSICS_DISCRETE = 0, PHYSICS_CONTINUOUS = 1, PHYSICS_CONTINUOUS_DYNAMIC = 2, PHYSICS_SPECULATIVE = 3 };

enum { PHYSICS_OVERLAPS = 1, PHYSICS_CONTACTS = 2 };

typedef struct {
    int32_t kind;
    float radius;             /* of a sphere or capsule */
    physics_vector half;      /* half sizes of a box; of a capsule x is half the length between its centres */
    const physics_mesh *mesh; /* a world's shapes keep it alive */
} physics_geometry;

typedef struct {
    float static_friction, dynamic_friction, bounciness; /* 0 or more; bounciness at most 1 */
    int32_t friction_combine, bounce_combine;            /* when two differ, the later of the four wins */
} physics_material;

typedef struct {
    physics_geometry geometry;
    physics_pose pose; /* in the actor's frame; a capsule lies along x */
    physics_material material;
    uint32_t identity; /* the caller's number: names pairs to ignore, orders reports */
    int32_t layer;     /* 0 to 31 */
    int32_t trigger;   /* solves nothing, reports overlaps */
    int32_t reports;   /* bits: PHYSICS_OVERLAPS, PHYSICS_CONTACTS; a pair is reported if one of its shapes has the bit */
    int32_t detection; /* collision detection mode of its body */
} physics_shape;

/* Adds a shape to an actor. PHYSICS_NONE, with physics_error set, when the geometry is impossible (such as a concave mesh on a dynamic body that is
 * not kinematic). */
PHYSICS_API int32_t physics_shape_create(physics_world *world, int32_t actor, const physics_shape *shape);

/* Changes all properties of a shape except its trigger flag. Returns 0, with physics_error set, when the geometry is impossible; nothing changes then. */
PHYSICS_API int32_t physics_shape_change(physics_world *world, int32_t shape, const physics_shape *to);

/* Removes a shape. Its touches end without a report. */
PHYSICS_API void physics_shape_destroy(physics_world *world, int32_t shape);

/* Returns the axis-aligned bounds of a shape in the world. */
PHYSICS_API void physics_shape_bounds(physics_world *world, int32_t shape, physics_vector *least, physics_vector *most);

/* ---- Meshes ---- */

/* Creates a mesh from points and triangles (three indices each). A convex one is the hull around the points, of at most 255 corners; a concave one has
 * no inside. NULL, with physics_error set, when the hull or mesh cannot be built. Any thread may call this. */
PHYSICS_API physics_mesh *physics_mesh_create(const physics_vector *points, int32_t point_count, const int32_t *indices,
                                              int32_t index_count, int32_t convex);

/* Releases the caller's reference to the mesh. */
PHYSICS_API void physics_mesh_release(physics_mesh *mesh);

/* ---- Joints ---- */

enum { PHYSICS_FIXED = 0, PHYSICS_HINGE = 1, PHYSICS_SPRING = 2 };

typedef struct {
    int32_t kind;
    int32_t actor;                     /* a body */
    int32_t other;                     /* another actor, or PHYSICS_NONE for the world */
    physics_pose pose, other_pose;     /* of the joint in both actors' frames, or the world's; a hinge turns about their x axes */
    float break_force, break_torque;   /* N, N m; infinite: it never breaks */
    int32_t collide;                   /* whether the two actors collide */
    int32_t use_limits, use_motor;     /* of a hinge */
    float least, most;                 /* angles of a hinge with limits; distances of a spring */
    float motor_velocity, motor_force; /* rad/s; maximum torque in N m */
    float spring, damper,
        target; /* N/m and N s/m, or N m/rad and N m s/rad; the angle of a hinge's spring, the tolerance of a spring's distance */
} physics_joint;

/* Creates a joint without waking bodies. Returns PHYSICS_NONE and sets physics_error on failure. A joint is destroyed with either actor, or when it breaks. */
PHYSICS_API int32_t physics_joint_create(physics_world *world, const physics_joint *joint);

PHYSICS_API void physics_joint_destroy(physics_world *world, int32_t joint);

/* ---- Steps ---- */

/* Kinds of commands, which are applied in the order of the array. By default `value` contains x, y, z. Static actors accept only POSE. */
enum {
    PHYSICS_POSE = 0,   /* position and rotation, applied immediately */
    PHYSICS_TARGET = 1, /* position and rotation that a kinematic body reaches in the next step */
    PHYSICS_VELOCITY = 2,
    PHYSICS_SPIN = 3,
    PHYSICS_FORCE = 4,  /* + 0 to 3: force, impulse, velocity change, acceleration */
    PHYSICS_TORQUE = 8, /* + 0 to 3 */
    PHYSICS_WAKE = 12,
    PHYSICS_SLEEP = 13,
    PHYSICS_KINEMATIC = 14,   /* x: 0 or 1 */
    PHYSICS_GRAVITY = 15,     /* x: 0 or 1 */
    PHYSICS_DAMPING = 16,     /* x: linear, y: angular */
    PHYSICS_LIMITS = 17,      /* x: linear velocity, y: angular velocity, z: velocity out of a penetration */
    PHYSICS_FREEZE = 18,      /* x: bits 0 to 2 freeze positions along x, y, z; bits 3 to 5 rotations about the axes of the inertia */
    PHYSICS_MASS = 19,        /* x: mass */
    PHYSICS_MASS_CENTER = 20, /* in the actor's frame; a fourth value of 0 restores the computed one */
    PHYSICS_SLEEP_BELOW = 21, /* x: kinetic energy per mass */
    PHYSICS_ITERATIONS = 22,  /* x: for positions, y: for velocities */
    PHYSICS_DETECTION = 23,   /* x: collision detection mode */
    PHYSICS_INERTIA = 24      /* diagonal, then rotation; a rotation of only 0 restores the computed one */
};

typedef struct {
    int32_t actor, kind;
    float value[7];
} physics_command;

/* The pose and velocities of a body. */
typedef struct {
    int32_t step; /* the step in which it last moved or fell asleep */
    int32_t asleep;
    physics_pose pose;
    physics_vector velocity, spin;
} physics_motion;

enum { PHYSICS_ENTER = 0, PHYSICS_STAY = 1, PHYSICS_EXIT = 2 };

/* A pair of shapes that touch or touched; a has the lower identity. */
typedef struct {
    int32_t a, b;
    int32_t phase;
    int32_t trigger;
    int32_t first_contact, contact_count; /* in `contacts`; none for triggers and exits */
    physics_vector relative_velocity;     /* of b as seen from a, before the contact was solved */
} physics_touch;

typedef struct {
    physics_vector point;
    physics_vector normal;  /* out of b, into a */
    physics_vector impulse; /* on a, N s */
    float separation;       /* negative: penetration */
} physics_contact;

typedef struct {
    int32_t joint; /* it no longer exists */
    float force;   /* that the joint applied to its body in the step, N */
} physics_break;

typedef struct {
    const physics_touch *touches; /* by identities */
    const physics_contact *contacts;
    const physics_break *broken; /* joints that broke in this step */
    int32_t touch_count, contact_count, broken_count;
} physics_result;

/* Applies commands without a step. */
PHYSICS_API void physics_apply(physics_world *world, const physics_command *commands, int32_t count);

/* Applies commands and moves the world by `seconds` (above 0). Returns 0, with physics_error set and nothing moved, when more shapes are in one
 * place than memory allows pairs of. `motions` has an item for each handle of a body; the bodies that move or fall asleep are written, with
 * the step's number. A body whose motion became infinite is reset to its last pose, stopped, and reported in physics_error. */
PHYSICS_API int32_t physics_step(physics_world *world, const physics_command *commands, int32_t count, float seconds,
                                 const physics_vector *gravity, int32_t number, physics_motion *motions, physics_result *result);

/* ---- Queries ----
 * They see shapes where the last step or POSE command put them. `layers` is a mask; triggers are included only on request. */

typedef struct {
    uint32_t layers;
    int32_t triggers;
    int32_t faces; /* of meshes, for rays: 0 or a sum of PHYSICS_BACK_FACES and PHYSICS_ALL_FACES */
} physics_filter;

typedef struct {
    physics_vector origin, direction; /* the direction has length 1 */
    float distance;
} physics_ray;

typedef struct {
    physics_vector centre;
    float radius;
} physics_sphere;

typedef struct {
    int32_t shape;    /* PHYSICS_NONE: nothing was hit */
    int32_t triangle; /* of a concave mesh, or PHYSICS_NONE */
    physics_vector point, normal;
    float distance;
} physics_hit;

/* The nearest hit of each ray; shapes that contain its origin are not hit. There are as many filters and hits as rays. All threads work on them. */
PHYSICS_API void physics_raycast(physics_world *world, const physics_ray *rays, const physics_filter *filters, int32_t count,
                                 physics_hit *hits);

/* All shapes that a ray hits, or all faces with PHYSICS_ALL_FACES, in no particular order; returns their number, at most `capacity`. */
PHYSICS_API int32_t physics_raycast_all(physics_world *world, const physics_ray *ray, const physics_filter *filter, physics_hit *hits,
                                        int32_t capacity);

/* One shape alone. Returns whether it was hit. */
PHYSICS_API int32_t physics_raycast_shape(physics_world *world, int32_t shape, const physics_ray *ray, physics_hit *hit);

/* All shapes that overlap a geometry, in no particular order; returns their number, at most `capacity`. */
PHYSICS_API int32_t physics_overlap(physics_world *world, const physics_geometry *geometry, const physics_pose *pose,
                                    const physics_filter *filter, int32_t *shapes, int32_t capacity);

/* Begins to find all shapes that overlap each of several spheres, in no particular order: `capacity` places of `shapes` (1 or more) for each sphere, what
 * does not fit is skipped; PHYSICS_NONE ends those that are fewer. There are as many filters as spheres. The world's other threads work on them; until
 * physics_finish_overlaps the arrays belong to the world, and no other function may be called with it. */
PHYSICS_API void physics_begin_overlaps(physics_world *world, const physics_sphere *spheres, const physics_filter *filters, int32_t count,
                                        int32_t *shapes, int32_t capacity);

/* Processes the remaining spheres and returns when all results are complete. */
PHYSICS_API void physics_finish_overlaps(physics_world *world);

/* Moves a geometry along a ray from its pose. Returns the number of hits. With a capacity of 0, writes the nearest hit, without shapes that the geometry
 * overlaps at the start. Otherwise writes all hits in no particular order; a hit with an overlap at the start has distance 0, point 0 and the reversed
 * direction as its normal. `point` is the point of contact. */
PHYSICS_API int32_t physics_sweep(physics_world *world, const physics_geometry *geometry, const physics_pose *pose,
                                  const physics_vector *direction, float distance, const physics_filter *filter, physics_hit *hits,
                                  int32_t capacity);

/* The same with all shapes of a body except triggers; the body itself is not hit. */
PHYSICS_API int32_t physics_sweep_actor(physics_world *world, int32_t actor, const physics_vector *direction, float distance,
                                        int32_t triggers, physics_hit *hits, int32_t capacity);

/* The point of a shape nearest to `point`: that point itself inside the shape, or for a concave mesh. `at`, if not NULL, is the pose of its
 * geometry in the world. */
PHYSICS_API void physics_closest_point(physics_world *world, int32_t shape, const physics_pose *at, const physics_vector *point,
                                       physics_vector *closest);

/* Whether two shapes overlap with their geometries at these poses; then the direction and distance that move the first out of the other. */
PHYSICS_API int32_t physics_penetration(physics_world *world, int32_t shape, const physics_pose *at, int32_t other,
                                        const physics_pose *other_at, physics_vector *direction, float *distance);

#ifdef __cplusplus
}
#endif

#endif
