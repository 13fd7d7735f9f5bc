// The world with its actors, shapes and reports, shared by all parts of the library.
#ifndef COLLEKTIVE_WORLD_HPP
#define COLLEKTIVE_WORLD_HPP

#include <PxPhysicsAPI.h>

#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "collektive_physics.h"
#include "workers.hpp"

struct physics_mesh {
    physx::PxRefCounted *base;
    bool convex;
};

namespace collektive {

using namespace physx;

// The foundation, PhysX and its cooking, created on first use and kept until the process ends.
PxPhysics &physics();
// Keeps the first of several errors until it is read.
void fail(const std::string &message);

inline PxVec3 vec(const physics_vector &v) { return PxVec3(v.x, v.y, v.z); }
inline physics_vector vec(const PxVec3 &v) { return {v.x, v.y, v.z}; }
inline PxTransform pose(const physics_pose &p) {
    return PxTransform(vec(p.position), PxQuat(p.rotation.x, p.rotation.y, p.rotation.z, p.rotation.w).getNormalized());
}
inline physics_pose pose(const PxTransform &t) { return {vec(t.p), {t.q.x, t.q.y, t.q.z, t.q.w}}; }
inline std::vector<PxShape *> shapes_of(const PxRigidActor &actor) {
    std::vector<PxShape *> shapes(actor.getNbShapes());
    actor.getShapes(shapes.data(), PxU32(shapes.size()));
    return shapes;
}

struct Actor {
    PxRigidActor *rigid = nullptr; // null: the handle is free
    float mass = 1.0f;
    bool own_center = false, own_inertia = false;
    bool mass_stale = true;
    bool led = false;   // kinematic, and last moved by a pose instead of a target
    uint8_t frozen = 0; // bits 0 to 2: the axes of the inertia about which the body does not rotate
    PxVec3 center = PxVec3(0.0f), inertia = PxVec3(0.0f);
    PxQuat inertia_rotation = PxQuat(PxIdentity);
    PxTransform last_pose = PxTransform(PxIdentity);

    PxRigidDynamic *body() const { return rigid ? rigid->is<PxRigidDynamic>() : nullptr; }
};

// Of an actor.
enum Marks : uint8_t {
    PLACED = 1,      // moved by a command since the last step
    MOVED = 2,       // in the current step
    MOVED_BEFORE = 4 // in the previous step
};

struct Shape {
    PxShape *shape = nullptr; // null: the handle is free
    int32_t actor = PHYSICS_NONE;
    uint32_t identity = 0;
    bool trigger = false;
    int32_t born = 0; // the step before which it was created or its pairs ended
};

struct Joint {
    PxJoint *joint = nullptr; // null: the handle is free
    int32_t actor = PHYSICS_NONE, other = PHYSICS_NONE;
    bool separates = false; // whether its bodies do not collide
};

// A pair with a trigger whose bounds overlap. PhysX finds the pair, and the library tests it, because PhysX ignores pairs of two triggers.
struct Overlap {
    int32_t a = PHYSICS_NONE, b = PHYSICS_NONE; // a has the lower identity
    bool touching = false;
    bool tested = false;
};

// A touching pair that PhysX no longer reports. If a body became kinematic or dynamic, or layers or ignored pairs changed, the touch ends,
// and begins again if the pair is found, as in Unity.
struct LostOverlap {
    int32_t a, b;
    bool ends;
};

// The words of PxFilterData of a simulated shape.
enum FilterBits : PxU32 {
    LAYER = 31,
    TRIGGER = 1 << 5,
    OVERLAPS = 1 << 6,
    CONTACTS = 1 << 7,
    CONTINUOUS = 1 << 8,
    CONTINUOUS_DYNAMIC = 1 << 9
};

// Data of the filter shader, which runs on worker threads. It changes only between steps.
struct Ignored {
    uint32_t layers[32] = {};
    std::unordered_set<uint64_t> pairs;

    static uint64_t key(uint32_t a, uint32_t b) { return a < b ? uint64_t(a) << 32 | b : uint64_t(b) << 32 | a; }
};

// Returns the handle of a free slot: the last released one, or a new one.
template <typename Slot> int32_t take(std::vector<Slot> &slots, std::vector<int32_t> &free) {
    if (free.empty()) {
        slots.emplace_back();
        return int32_t(slots.size() - 1);
    }
    const int32_t handle = free.back();
    free.pop_back();
    return handle;
}

PxQueryFilterData query_filter(const physics_filter &filter, PxQueryFlags flags);
bool make_geometry(const physics_geometry &from, PxGeometryHolder &to);

} // namespace collektive

struct physics_world final : physx::PxSimulationEventCallback, physx::PxSimulationFilterCallback {
    explicit physics_world(int32_t threads);
    ~physics_world();

    collektive::Workers workers;
    physx::PxScene *scene = nullptr;
    std::vector<collektive::Actor> actors;
    std::vector<collektive::Shape> shapes;
    std::vector<collektive::Joint> joints;
    std::vector<int32_t> free_actors, free_shapes, free_joints;
    // Keys of the pairs of actors whose joints disable collisions, as of the last step, and of the pairs whose joints changed since.
    std::unordered_set<uint64_t> separated, rejoined;
    std::unordered_map<std::string, physx::PxMaterial *> materials;
    bool improved_friction = false; // of the materials
    collektive::Ignored ignored;
    size_t placed = 0;         // shapes created or moved since the last step
    bool masses_stale = false; // of any actor
    // By the actor's handle. A step iterates over all of them, but only over few actors.
    std::vector<uint8_t> marks;
    std::vector<int32_t> moved; // of collect_motions, kept for its memory

    std::vector<collektive::Overlap> overlaps; // by PhysX's number of the pair
    // Touching pairs whose bounds separated, or that wait for a new filtering, by identities.
    std::map<uint64_t, collektive::LostOverlap> lost_overlaps;
    // Why PhysX removes a pair. Touches of removed shapes are dropped. Touches of pairs that are filtered again continue or end.
    enum { REMOVED, CONTINUES, ENDS } removal = REMOVED;

    int32_t steps = 0;
    // Whether pairs are filtered again that continue to touch, and the keys of those that touch. PhysX reports the latter as found.
    bool resumes = false;
    std::unordered_set<uint64_t> resumed;

    std::vector<physics_touch> touches;
    std::vector<physics_contact> contacts;
    std::vector<physics_break> broken;

    collektive::Actor *actor(int32_t handle) {
        return handle >= 0 && size_t(handle) < actors.size() && actors[handle].rigid ? &actors[handle] : nullptr;
    }
    collektive::Shape *shape(int32_t handle) {
        return handle >= 0 && size_t(handle) < shapes.size() && shapes[handle].shape ? &shapes[handle] : nullptr;
    }
    physx::PxMaterial *material(const physics_material &wanted);
    void mass_changed(collektive::Actor &actor) { actor.mass_stale = masses_stale = true; }
    void refresh_mass(collektive::Actor &actor);
    physx::PxVec3 without_frozen(collektive::Actor &actor, const physx::PxVec3 &spin);
    bool is_active(int32_t actor) const;
    void drop_shape(int32_t handle);
    void drop_joint(int32_t handle);
    void drop_joints_of(int32_t actor);
    void filter_joined();
    void apply(const physics_command &command);
    void apply_all(const physics_command *commands, int32_t count);
    bool crowded();
    void collect_motions(int32_t step, physics_motion *motions);
    void reset_body(int32_t handle, physics_motion &motion);
    void collect_overlaps();
    void resume_contacts();
    void add_touch(int32_t a, int32_t b, int32_t phase, bool trigger);

    // PxSimulationEventCallback, all on the stepping thread
    void onContact(const physx::PxContactPairHeader &header, const physx::PxContactPair *pairs, physx::PxU32 count) override;
    void onSleep(physx::PxActor **sleepers, physx::PxU32 count) override;
    void onConstraintBreak(physx::PxConstraintInfo *constraints, physx::PxU32 count) override;
    void onWake(physx::PxActor **, physx::PxU32) override {}
    void onTrigger(physx::PxTriggerPair *, physx::PxU32) override {}
    void onAdvance(const physx::PxRigidBody *const *, const physx::PxTransform *, const physx::PxU32) override {}

    // PxSimulationFilterCallback, called one after another
    physx::PxFilterFlags pairFound(physx::PxU32 pair, physx::PxFilterObjectAttributes, physx::PxFilterData, const physx::PxActor *,
                                   const physx::PxShape *shape0, physx::PxFilterObjectAttributes, physx::PxFilterData,
                                   const physx::PxActor *, const physx::PxShape *shape1, physx::PxPairFlags &flags) override;
    void pairLost(physx::PxU32 pair, physx::PxFilterObjectAttributes, physx::PxFilterData, physx::PxFilterObjectAttributes,
                  physx::PxFilterData, bool removed) override;
    bool statusChange(physx::PxU32 &, physx::PxPairFlags &, physx::PxFilterFlags &) override { return false; }
};

#endif
