// Worlds, actors and shapes.
#include "world.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <new>

namespace collektive {

static std::mutex error_turn; // guards the texts, because worker threads report errors too
static std::string error_text, error_read;

void fail(const std::string &message) {
    std::lock_guard<std::mutex> turn(error_turn);
    if (error_text.empty()) error_text = message;
}

namespace {

struct Reporter final : PxErrorCallback {
    void reportError(PxErrorCode::Enum code, const char *message, const char *, int) override {
        if (code != PxErrorCode::eDEBUG_INFO && code != PxErrorCode::ePERF_WARNING) fail(std::string("PhysX: ") + message);
    }
};

PxFilterFlags filter_pair(PxFilterObjectAttributes attributes0, PxFilterData data0, PxFilterObjectAttributes attributes1,
                          PxFilterData data1, PxPairFlags &flags, const void *constants, PxU32) {
    const Ignored &ignored = **static_cast<const Ignored *const *>(constants);
    if (ignored.layers[data0.word0 & LAYER] >> (data1.word0 & LAYER) & 1) return PxFilterFlag::eSUPPRESS;
    if (!ignored.pairs.empty() && ignored.pairs.count(Ignored::key(data0.word1, data1.word1))) return PxFilterFlag::eSUPPRESS;
    const PxU32 either = data0.word0 | data1.word0;
    if (either & TRIGGER)
        return either & OVERLAPS ? PxFilterFlag::eNOTIFY | PxFilterFlag::eSUPPRESS : PxFilterFlags(PxFilterFlag::eSUPPRESS);
    const bool static0 = PxGetFilterObjectType(attributes0) == PxFilterObjectType::eRIGID_STATIC;
    const bool static1 = PxGetFilterObjectType(attributes1) == PxFilterObjectType::eRIGID_STATIC;
    // If the second object is kinematic, PhysX 5.1 sets the flag in the first object's attributes.
    const bool kinematic = PxFilterObjectIsKinematic(attributes0) || PxFilterObjectIsKinematic(attributes1);
    if (kinematic && (static0 || static1)) return PxFilterFlag::eSUPPRESS;
    flags = PxPairFlag::eCONTACT_DEFAULT;
    // Continuous bodies are swept against static shapes, ContinuousDynamic ones also against continuous bodies.
    const PxU32 continuous0 = data0.word0 & (CONTINUOUS | CONTINUOUS_DYNAMIC),
                continuous1 = data1.word0 & (CONTINUOUS | CONTINUOUS_DYNAMIC);
    const bool swept = static0   ? continuous1
                       : static1 ? continuous0
                                 : continuous0 && continuous1 && ((continuous0 | continuous1) & CONTINUOUS_DYNAMIC);
    if (swept) flags |= PxPairFlag::eDETECT_CCD_CONTACT;
    if (either & CONTACTS)
        flags |= PxPairFlag::eNOTIFY_TOUCH_FOUND | PxPairFlag::eNOTIFY_TOUCH_PERSISTS | PxPairFlag::eNOTIFY_TOUCH_LOST |
                 PxPairFlag::eNOTIFY_CONTACT_POINTS | PxPairFlag::ePRE_SOLVER_VELOCITY;
    return kinematic ? PxFilterFlag::eCALLBACK : PxFilterFlag::eDEFAULT;
}

bool finite(const physics_geometry &geometry) {
    return std::isfinite(geometry.radius) && std::isfinite(geometry.half.x) && std::isfinite(geometry.half.y) &&
           std::isfinite(geometry.half.z);
}

bool finite(const physics_pose &at) {
    return std::isfinite(at.position.x + at.position.y + at.position.z + at.rotation.x + at.rotation.y + at.rotation.z + at.rotation.w);
}

void set_filters(PxShape &target, const physics_shape &from) {
    const PxU32 layer = PxU32(from.layer) & LAYER;
    PxFilterData data;
    data.word0 = layer;
    if (from.trigger) data.word0 |= TRIGGER;
    if (from.reports & PHYSICS_OVERLAPS) data.word0 |= OVERLAPS;
    if (from.reports & PHYSICS_CONTACTS) data.word0 |= CONTACTS;
    if (from.detection == PHYSICS_CONTINUOUS) data.word0 |= CONTINUOUS;
    if (from.detection == PHYSICS_CONTINUOUS_DYNAMIC) data.word0 |= CONTINUOUS_DYNAMIC;
    data.word1 = from.identity;
    target.setSimulationFilterData(data);
    // Word 0 is tested by all queries, word 1 by queries that include triggers.
    PxFilterData query;
    (from.trigger ? query.word1 : query.word0) = 1u << layer;
    target.setQueryFilterData(query);
}

} // namespace

PxPhysics &physics() {
    static PxPhysics *instance = [] {
        static PxDefaultAllocator allocator;
        static Reporter reporter;
        PxFoundation *foundation = PxCreateFoundation(PX_PHYSICS_VERSION, allocator, reporter);
        return PxCreatePhysics(PX_PHYSICS_VERSION, *foundation, PxTolerancesScale());
    }();
    return *instance;
}

bool make_geometry(const physics_geometry &from, PxGeometryHolder &to) {
    const float thinnest = 1e-4f; // PhysX refuses sizes of 0, Unity makes them thin
    if (!finite(from)) {
        fail("A shape's size is not finite.");
        return false;
    }
    switch (from.kind) {
        case PHYSICS_SPHERE: to.storeAny(PxSphereGeometry(std::max(from.radius, thinnest))); return true;
        case PHYSICS_BOX:
            to.storeAny(PxBoxGeometry(std::max(from.half.x, thinnest), std::max(from.half.y, thinnest), std::max(from.half.z, thinnest)));
            return true;
        case PHYSICS_CAPSULE: to.storeAny(PxCapsuleGeometry(std::max(from.radius, thinnest), std::max(from.half.x, thinnest))); return true;
        case PHYSICS_MESH:
            if (!from.mesh) break;
            if (from.mesh->convex)
                to.storeAny(PxConvexMeshGeometry(static_cast<PxConvexMesh *>(from.mesh->base)));
            else
                to.storeAny(PxTriangleMeshGeometry(static_cast<PxTriangleMesh *>(from.mesh->base)));
            return true;
    }
    fail("A shape has no geometry.");
    return false;
}

} // namespace collektive

using namespace collektive;

physics_world::physics_world(int32_t threads) : workers(threads) {
    PxSceneDesc description(physics().getTolerancesScale());
    description.gravity = PxVec3(0.0f, -9.81f, 0.0f);
    description.cpuDispatcher = &workers;
    static_assert(sizeof(Ignored *) == 8, "the filter shader's constants are one pointer");
    const Ignored *constants = &ignored;
    description.filterShader = filter_pair;
    description.filterShaderData = &constants;
    description.filterShaderDataSize = sizeof constants;
    description.filterCallback = this;
    description.simulationEventCallback = this;
    description.kineKineFilteringMode = PxPairFilteringMode::eKEEP; // for triggers
    description.staticKineFilteringMode = PxPairFilteringMode::eKEEP;
    description.bounceThresholdVelocity = 2.0f;
    description.flags = PxSceneFlag::eENABLE_PCM | PxSceneFlag::eENABLE_CCD | PxSceneFlag::eENABLE_ACTIVE_ACTORS |
                        PxSceneFlag::eENABLE_ENHANCED_DETERMINISM;
    // Queries update their trees on demand, not in every step.
    description.sceneQueryUpdateMode = PxSceneQueryUpdateMode::eBUILD_ENABLED_COMMIT_DISABLED;
    scene = physics().createScene(description);
}

physics_world::~physics_world() {
    for (Joint &each : joints)
        if (each.joint) each.joint->release();
    for (Actor &each : actors)
        if (each.rigid) each.rigid->release();
    if (scene) scene->release();
    for (auto &entry : materials) entry.second->release();
}

PxMaterial *physics_world::material(const physics_material &wanted) {
    const std::string key(reinterpret_cast<const char *>(&wanted), sizeof wanted);
    PxMaterial *&known = materials[key];
    if (known) return known;
    // PhysX numbers materials with 16 bits, so unused ones are released.
    if (materials.size() > 10000)
        for (auto entry = materials.begin(); entry != materials.end();) {
            if (entry->second && entry->second->getReferenceCount() == 1) {
                entry->second->release();
                entry = materials.erase(entry);
            } else
                ++entry;
        }
    const auto finite_or = [](float value, float otherwise) { return std::isfinite(value) ? value : otherwise; };
    PxMaterial *made = physics().createMaterial(std::max(0.0f, finite_or(wanted.static_friction, 0.6f)),
                                                std::max(0.0f, finite_or(wanted.dynamic_friction, 0.6f)),
                                                std::min(1.0f, std::max(0.0f, finite_or(wanted.bounciness, 0.0f))));
    made->setFrictionCombineMode(PxCombineMode::Enum(wanted.friction_combine & 3)); // the numbers are PhysX's
    made->setRestitutionCombineMode(PxCombineMode::Enum(wanted.bounce_combine & 3));
    made->setFlag(PxMaterialFlag::eIMPROVED_PATCH_FRICTION, improved_friction);
    return materials[key] = made;
}

void physics_world::refresh_mass(Actor &actor) {
    PxRigidDynamic *body = actor.body();
    if (!body || !actor.mass_stale) return;
    actor.mass_stale = false;
    std::vector<PxShape *> solid = shapes_of(*body);
    solid.erase(std::remove_if(solid.begin(), solid.end(),
                               [](PxShape *shape) {
                                   return (shape->getSimulationFilterData().word0 & TRIGGER) ||
                                          shape->getGeometry().getType() == PxGeometryType::eTRIANGLEMESH;
                               }),
                solid.end());
    PxTransform center(PxIdentity);
    PxVec3 inertia(1.0f); // without solid shapes, as in Unity
    if (!solid.empty()) {
        const PxMassProperties total = PxRigidBodyExt::computeMassPropertiesFromShapes(solid.data(), PxU32(solid.size()));
        center.p = total.centerOfMass;
        inertia = PxMassProperties::getMassSpaceInertia(total.inertiaTensor, center.q) * (actor.mass / total.mass);
    }
    if (actor.own_center) center.p = actor.center;
    if (actor.own_inertia) {
        inertia = actor.inertia;
        center.q = actor.inertia_rotation;
    }
    // As in Unity. PhysX's locks are about the axes of the world, and would weaken friction.
    for (PxU32 axis = 0; axis < 3; axis++)
        if (actor.frozen >> axis & 1) inertia[axis] = 0.0f;
    body->setCMassLocalPose(center);
    body->setMass(actor.mass);
    body->setMassSpaceInertiaTensor(inertia);
}

// Returns a spin in the frame of the world without its components about frozen axes.
PxVec3 physics_world::without_frozen(Actor &actor, const PxVec3 &spin) {
    if (!actor.frozen) return spin;
    refresh_mass(actor);
    const PxQuat axes = actor.rigid->getGlobalPose().q * actor.body()->getCMassLocalPose().q;
    PxVec3 own = axes.rotateInv(spin);
    for (PxU32 axis = 0; axis < 3; axis++)
        if (actor.frozen >> axis & 1) own[axis] = 0.0f;
    return axes.rotate(own);
}

void physics_world::drop_shape(int32_t handle) {
    Shape &dying = shapes[handle];
    Actor &owner = actors[dying.actor];
    mass_changed(owner);
    owner.rigid->detachShape(*dying.shape);
    dying = Shape();
    free_shapes.push_back(handle);
    for (auto entry = lost_overlaps.begin(); entry != lost_overlaps.end();) {
        if (entry->second.a == handle || entry->second.b == handle)
            entry = lost_overlaps.erase(entry);
        else
            ++entry;
    }
}

extern "C" {

int32_t physics_version(void) { return PHYSICS_VERSION; }

const char *physics_error(void) {
    std::lock_guard<std::mutex> turn(error_turn);
    error_read.swap(error_text);
    error_text.clear();
    return error_read.c_str();
}

physics_world *physics_world_create(int32_t threads) {
    physics_world *world = new (std::nothrow) physics_world(threads);
    if (world && !world->scene) {
        delete world;
        return nullptr;
    }
    return world;
}

void physics_world_destroy(physics_world *world) { delete world; }

static void filter_again(physics_world *world, Shape &shape) {
    shape.born = world->steps;
    PxRigidActor &actor = *world->actors[shape.actor].rigid;
    if (!actor.getScene()) return;
    world->removal = physics_world::ENDS;
    world->scene->resetFiltering(actor, &shape.shape, 1);
    world->removal = physics_world::REMOVED;
}

void physics_ignore_layers(physics_world *world, const uint32_t rows[32]) {
    uint32_t changed = 0;
    for (int layer = 0; layer < 32; layer++) changed |= uint32_t(world->ignored.layers[layer] != rows[layer]) << layer;
    std::memcpy(world->ignored.layers, rows, sizeof world->ignored.layers);
    for (Shape &each : world->shapes)
        if (each.shape && changed >> (each.shape->getSimulationFilterData().word0 & LAYER) & 1) filter_again(world, each);
}

void physics_ignore_pair(physics_world *world, uint32_t identity, uint32_t other, int32_t shape, int32_t other_shape, int32_t ignore) {
    const bool changed = ignore ? world->ignored.pairs.insert(Ignored::key(identity, other)).second
                                : world->ignored.pairs.erase(Ignored::key(identity, other)) > 0;
    Shape *first = world->shape(shape), *second = world->shape(other_shape);
    if (!changed || !first || !second) return;
    filter_again(world, *first);
    filter_again(world, *second);
}

void physics_improve_friction(physics_world *world, int32_t improved) {
    world->improved_friction = improved != 0;
    for (auto &entry : world->materials) entry.second->setFlag(PxMaterialFlag::eIMPROVED_PATCH_FRICTION, world->improved_friction);
}

int32_t physics_actor_create(physics_world *world, int32_t kind, const physics_pose *at) {
    if (!finite(*at)) {
        fail("An actor's pose is not finite.");
        return PHYSICS_NONE;
    }
    const int32_t handle = take(world->actors, world->free_actors);
    Actor made;
    made.last_pose = pose(*at);
    if (kind == PHYSICS_DYNAMIC) {
        PxRigidDynamic *body = physics().createRigidDynamic(made.last_pose);
        body->setLinearDamping(0.0f);
        body->setAngularDamping(0.05f);
        body->setMaxAngularVelocity(7.0f);
        body->setMaxDepenetrationVelocity(10.0f);
        body->setSleepThreshold(0.005f);
        body->setSolverIterationCounts(6, 1);
        body->setActorFlag(PxActorFlag::eSEND_SLEEP_NOTIFIES, true);
        made.rigid = body;
    } else
        made.rigid = physics().createRigidStatic(made.last_pose);
    made.rigid->userData = reinterpret_cast<void *>(intptr_t(handle));
    world->actors[handle] = made;
    world->masses_stale = true;
    world->marks.resize(world->actors.size());
    world->marks[handle] = PLACED;
    world->scene->addActor(*made.rigid);
    return handle;
}

void physics_actor_destroy(physics_world *world, int32_t handle) {
    Actor *dying = world->actor(handle);
    if (!dying) return;
    world->drop_joints_of(handle);
    for (const PxShape *each : shapes_of(*dying->rigid)) world->drop_shape(int32_t(intptr_t(each->userData)));
    dying->rigid->release();
    *dying = Actor();
    world->marks[handle] = 0;
    world->free_actors.push_back(handle);
}

void physics_mass_center(physics_world *world, int32_t handle, physics_vector *center) {
    *center = {0.0f, 0.0f, 0.0f};
    Actor *actor = world->actor(handle);
    if (!actor || !actor->body()) return;
    world->refresh_mass(*actor);
    *center = vec(actor->body()->getCMassLocalPose().p);
}

void physics_inertia(physics_world *world, int32_t handle, physics_vector *diagonal, physics_quaternion *rotation) {
    *diagonal = {0.0f, 0.0f, 0.0f};
    *rotation = {0.0f, 0.0f, 0.0f, 1.0f};
    Actor *actor = world->actor(handle);
    if (!actor || !actor->body()) return;
    world->refresh_mass(*actor);
    const PxQuat turn = actor->body()->getCMassLocalPose().q;
    *diagonal = vec(actor->body()->getMassSpaceInertiaTensor());
    *rotation = {turn.x, turn.y, turn.z, turn.w};
}

int32_t physics_shape_create(physics_world *world, int32_t owner, const physics_shape *from) {
    Actor *actor = world->actor(owner);
    PxGeometryHolder geometry;
    if (!actor || !make_geometry(from->geometry, geometry)) return PHYSICS_NONE;
    if (!finite(from->pose)) {
        fail("A shape's pose is not finite.");
        return PHYSICS_NONE;
    }
    PxRigidDynamic *body = actor->body();
    const bool concave = geometry.getType() == PxGeometryType::eTRIANGLEMESH;
    if (concave && body && !(body->getRigidBodyFlags() & PxRigidBodyFlag::eKINEMATIC)) {
        fail("A concave mesh cannot be a shape of a body that is not kinematic.");
        return PHYSICS_NONE;
    }
    PxShape *made = physics().createShape(geometry.any(), *world->material(from->material), true,
                                          PxShapeFlag::eSIMULATION_SHAPE | PxShapeFlag::eSCENE_QUERY_SHAPE);
    if (!made) {
        fail("PhysX refused a shape.");
        return PHYSICS_NONE;
    }
    const int32_t handle = take(world->shapes, world->free_shapes);
    made->userData = reinterpret_cast<void *>(intptr_t(handle));
    made->setContactOffset(0.01f);
    made->setLocalPose(pose(from->pose));
    set_filters(*made, *from);
    actor->rigid->attachShape(*made);
    made->release(); // the actor holds it
    world->mass_changed(*actor);
    world->placed++;
    Shape &slot = world->shapes[handle];
    slot.shape = made;
    slot.actor = owner;
    slot.identity = from->identity;
    slot.trigger = from->trigger != 0;
    slot.born = world->steps;
    return handle;
}

int32_t physics_shape_change(physics_world *world, int32_t handle, const physics_shape *to) {
    Shape *shape = world->shape(handle);
    PxGeometryHolder geometry;
    if (!shape || !make_geometry(to->geometry, geometry)) return 0;
    if (!finite(to->pose)) {
        fail("A shape's pose is not finite.");
        return 0;
    }
    if (geometry.getType() != shape->shape->getGeometry().getType()) {
        fail("The kind of geometry of a shape cannot be changed.");
        return 0;
    }
    const PxFilterData before = shape->shape->getSimulationFilterData();
    shape->shape->setGeometry(geometry.any());
    shape->shape->setLocalPose(pose(to->pose));
    PxMaterial *wanted = world->material(to->material);
    shape->shape->setMaterials(&wanted, 1);
    set_filters(*shape->shape, *to);
    Actor &actor = world->actors[shape->actor];
    const PxU32 difference = before.word0 ^ shape->shape->getSimulationFilterData().word0;
    if (difference) {
        PxShape *changed = shape->shape;
        if (difference & LAYER)
            shape->born = world->steps;
        else
            world->resumes = true;
        world->removal = difference & LAYER ? physics_world::ENDS : physics_world::CONTINUES;
        world->scene->resetFiltering(*actor.rigid, &changed, 1);
        world->removal = physics_world::REMOVED;
    }
    world->mass_changed(actor);
    world->placed++;
    return 1;
}

void physics_shape_destroy(physics_world *world, int32_t handle) {
    if (world->shape(handle)) world->drop_shape(handle);
}

void physics_shape_bounds(physics_world *world, int32_t handle, physics_vector *least, physics_vector *most) {
    *least = *most = {0.0f, 0.0f, 0.0f};
    Shape *shape = world->shape(handle);
    if (!shape) return;
    PxBounds3 bounds;
    PxGeometryQuery::computeGeomBounds(bounds, shape->shape->getGeometry(),
                                       PxShapeExt::getGlobalPose(*shape->shape, *world->actors[shape->actor].rigid));
    *least = vec(bounds.minimum);
    *most = vec(bounds.maximum);
}

} // extern "C"
