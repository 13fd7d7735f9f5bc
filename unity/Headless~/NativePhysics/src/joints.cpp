// Joints between two bodies, or a body and the world.
#include "world.hpp"

#include <cmath>

using namespace collektive;

namespace {

// N m s/rad: a motor reaches its velocity within a step, as far as its force goes.
const float STIFF = 1e5f;

float largest(float value) { return std::isfinite(value) ? value : PX_MAX_F32; }

// A hinge rotates about the x axes of its frames and fixes all other axes. Its angle is measured on the actor, relative to the other.
PxJoint *make_hinge(PxRigidActor *actor, const PxTransform &at, PxRigidActor *other, const PxTransform &other_at,
                    const physics_joint &from) {
    PxD6Joint *joint = PxD6JointCreate(physics(), other, other_at, actor, at);
    if (!joint) return nullptr;
    joint->setConstraintFlag(PxConstraintFlag::eDRIVE_LIMITS_ARE_FORCES, true);
    joint->setMotion(PxD6Axis::eTWIST, from.use_limits ? PxD6Motion::eLIMITED : PxD6Motion::eFREE);
    if (from.use_limits) joint->setTwistLimit(PxJointAngularLimitPair(from.least, from.most));
    if (from.use_motor) {
        joint->setDrive(PxD6Drive::eTWIST, PxD6JointDrive(0.0f, STIFF, largest(from.motor_force)));
        // PhysX's velocity is that of the first actor.
        joint->setDriveVelocity(PxVec3(0.0f), PxVec3(-from.motor_velocity, 0.0f, 0.0f));
    } else if (from.spring > 0.0f || from.damper > 0.0f) {
        joint->setDrive(PxD6Drive::eTWIST, PxD6JointDrive(from.spring, from.damper, PX_MAX_F32));
        joint->setDrivePosition(PxTransform(PxQuat(from.target, PxVec3(1.0f, 0.0f, 0.0f))));
    }
    return joint;
}

PxJoint *make_spring(PxRigidActor *actor, const PxTransform &at, PxRigidActor *other, const PxTransform &other_at,
                     const physics_joint &from) {
    PxDistanceJoint *joint = PxDistanceJointCreate(physics(), actor, at, other, other_at);
    if (!joint) return nullptr;
    joint->setMinDistance(from.least);
    joint->setMaxDistance(from.most);
    joint->setTolerance(from.target);
    joint->setStiffness(from.spring);
    joint->setDamping(from.damper);
    joint->setDistanceJointFlags(PxDistanceJointFlag::eMIN_DISTANCE_ENABLED | PxDistanceJointFlag::eMAX_DISTANCE_ENABLED |
                                 PxDistanceJointFlag::eSPRING_ENABLED);
    return joint;
}

} // namespace

void physics_world::drop_joint(int32_t handle) {
    joints[handle].joint->release();
    if (joints[handle].separates) rejoined.insert(Ignored::key(uint32_t(joints[handle].actor), uint32_t(joints[handle].other)));
    joints[handle] = Joint();
    free_joints.push_back(handle);
}

void physics_world::drop_joints_of(int32_t actor) {
    for (size_t handle = 0; handle < joints.size(); handle++)
        if (joints[handle].joint && (joints[handle].actor == actor || joints[handle].other == actor)) drop_joint(int32_t(handle));
}

// Filters pairs again whose joints disabled or enabled collisions. PhysX tests joints only when the bounds of two shapes begin to overlap.
void physics_world::filter_joined() {
    if (rejoined.empty()) return;
    std::unordered_set<uint64_t> now;
    for (const Joint &each : joints)
        if (each.joint && each.separates) now.insert(Ignored::key(uint32_t(each.actor), uint32_t(each.other)));
    for (const uint64_t key : rejoined) {
        const Actor *first = actor(int32_t(key >> 32));
        if (!first || now.count(key) == separated.count(key)) continue;
        std::vector<PxShape *> own = shapes_of(*first->rigid);
        resumes = true;
        removal = CONTINUES;
        scene->resetFiltering(*first->rigid, own.data(), PxU32(own.size()));
        removal = REMOVED;
    }
    rejoined.clear();
    separated.swap(now);
}

void physics_world::onConstraintBreak(PxConstraintInfo *constraints, PxU32 count) {
    for (PxU32 index = 0; index < count; index++) {
        const PxJoint *joint = static_cast<PxJoint *>(constraints[index].externalReference);
        broken.push_back({int32_t(intptr_t(joint->userData)), 0.0f});
    }
}

extern "C" {

int32_t physics_joint_create(physics_world *world, const physics_joint *from) {
    Actor *actor = world->actor(from->actor), *other = world->actor(from->other);
    if (!actor || !actor->body() || actor == other) {
        fail("A joint needs a body, and another one or the world.");
        return PHYSICS_NONE;
    }
    PxRigidActor *second = other ? other->rigid : nullptr;
    const PxTransform at = pose(from->pose), other_at = pose(from->other_pose);
    if (!at.isFinite() || !other_at.isFinite()) {
        fail("A joint's pose is not finite.");
        return PHYSICS_NONE;
    }
    world->refresh_mass(*actor);
    if (other) world->refresh_mass(*other);
    // A D6 joint without free axes is a fixed joint.
    PxJoint *made = from->kind == PHYSICS_HINGE    ? make_hinge(actor->rigid, at, second, other_at, *from)
                    : from->kind == PHYSICS_SPRING ? make_spring(actor->rigid, at, second, other_at, *from)
                                                   : PxD6JointCreate(physics(), actor->rigid, at, second, other_at);
    if (!made) {
        fail("PhysX refused a joint.");
        return PHYSICS_NONE;
    }
    made->setBreakForce(largest(from->break_force), largest(from->break_torque));
    made->setConstraintFlag(PxConstraintFlag::eCOLLISION_ENABLED, from->collide != 0);
    const int32_t handle = take(world->joints, world->free_joints);
    made->userData = reinterpret_cast<void *>(intptr_t(handle));
    world->joints[handle] = {made, from->actor, from->other, other && !from->collide};
    if (world->joints[handle].separates) world->rejoined.insert(Ignored::key(uint32_t(from->actor), uint32_t(from->other)));
    return handle;
}

void physics_joint_destroy(physics_world *world, int32_t handle) {
    if (handle >= 0 && size_t(handle) < world->joints.size() && world->joints[handle].joint) world->drop_joint(handle);
}

} // extern "C"
