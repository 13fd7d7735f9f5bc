// Commands, steps and reports.
#include <algorithm>
#include <cmath>

#include "world.hpp"

using namespace collektive;

namespace {

const PxForceMode::Enum FORCE_MODES[] = {PxForceMode::eFORCE, PxForceMode::eIMPULSE, PxForceMode::eVELOCITY_CHANGE,
                                         PxForceMode::eACCELERATION};

// A pair costs about half a kilobyte.
const uint64_t MAX_PAIRS = 4000000;
const size_t FEW_PLACED = 512;
// Bodies of large scenes are not in the cache. They are prefetched this number of bodies ahead.
const int AHEAD = 8;

bool all_finite(const float *value, int count) {
    for (int index = 0; index < count; index++)
        if (!std::isfinite(value[index])) return false;
    return true;
}

// Prefetches the part of a body that a step reads.
void prefetch(const PxRigidActor *body) {
    const size_t line = 64, lines = 5;
    const char *begin = reinterpret_cast<const char *>(body);
    for (size_t offset = 0; offset < line * lines; offset += line) __builtin_prefetch(begin + offset);
}

bool is_finite(const physics_motion &motion) { return all_finite(&motion.pose.position.x, 7) && all_finite(&motion.velocity.x, 6); }

bool spheres_overlap(const PxSphereGeometry &a, const PxVec3 &at_a, const PxSphereGeometry &b, const PxVec3 &at_b) {
    const float reach = a.radius + b.radius;
    return (at_a - at_b).magnitudeSquared() <= reach * reach;
}

// The last task that PhysX submits in a step.
struct Finish final : PxLightCpuTask {
    Workers &workers;
    std::atomic<bool> over{false};

    explicit Finish(physics_world &world) : workers(world.workers) { setContinuation(*world.scene->getTaskManager(), nullptr); }
    void run() override {}
    void release() override { workers.end(over); }
    const char *getName() const override { return "finish"; }
};

} // namespace

bool physics_world::is_active(int32_t actor) const {
    const PxRigidDynamic *body = actors[actor].body();
    return marks[actor] & (PLACED | MOVED_BEFORE) || (body && !body->isSleeping());
}

void physics_world::apply(const physics_command &command) {
    Actor *actor = this->actor(command.actor);
    const bool posed = command.kind == PHYSICS_POSE || command.kind == PHYSICS_TARGET || command.kind == PHYSICS_INERTIA;
    if (!actor) return;
    if (!all_finite(command.value, posed ? 7 : 3)) {
        fail("A command with a value that is not finite was ignored.");
        return;
    }
    const float *value = command.value;
    const PxVec3 vector(value[0], value[1], value[2]);
    PxRigidDynamic *body = actor->body();
    const bool kinematic = body && body->getRigidBodyFlags() & PxRigidBodyFlag::eKINEMATIC;
    if (command.kind == PHYSICS_POSE) {
        actor->last_pose = PxTransform(vector, PxQuat(value[3], value[4], value[5], value[6]).getNormalized());
        actor->rigid->setGlobalPose(actor->last_pose);
        // Kinematic bodies without a target would not wake the bodies that they touch.
        PxTransform target;
        if (kinematic && (actor->led || !body->getKinematicTarget(target))) {
            body->setKinematicTarget(actor->last_pose);
            actor->led = true;
        }
        marks[command.actor] |= PLACED;
        placed++;
        return;
    }
    if (!body) return;
    switch (command.kind) {
        case PHYSICS_TARGET:
            if (kinematic) body->setKinematicTarget(PxTransform(vector, PxQuat(value[3], value[4], value[5], value[6]).getNormalized()));
            actor->led = false;
            break;
        case PHYSICS_VELOCITY:
            if (!kinematic) body->setLinearVelocity(vector);
            break;
        case PHYSICS_SPIN:
            if (!kinematic) body->setAngularVelocity(vector);
            break;
        case PHYSICS_FORCE:
        case PHYSICS_FORCE + 1:
        case PHYSICS_FORCE + 2:
        case PHYSICS_FORCE + 3:
            if (kinematic) break;
            refresh_mass(*actor);
            body->addForce(vector, FORCE_MODES[command.kind - PHYSICS_FORCE]);
            break;
        case PHYSICS_TORQUE:
        case PHYSICS_TORQUE + 1:
        case PHYSICS_TORQUE + 2:
        case PHYSICS_TORQUE + 3:
            if (kinematic) break;
            refresh_mass(*actor);
            body->addTorque(without_frozen(*actor, vector), FORCE_MODES[command.kind - PHYSICS_TORQUE]);
            break;
        case PHYSICS_WAKE:
            if (!kinematic) body->wakeUp();
            break;
        case PHYSICS_SLEEP:
            if (!kinematic) body->putToSleep();
            break;
        case PHYSICS_KINEMATIC: {
            removal = ENDS;
            actor->led = false;
            // Otherwise, PhysX reports an error. A later command sets the detection mode.
            if (value[0] != 0.0f) body->setRigidBodyFlag(PxRigidBodyFlag::eENABLE_CCD, false);
            body->setRigidBodyFlag(PxRigidBodyFlag::eKINEMATIC, value[0] != 0.0f);
            removal = REMOVED;
            for (const PxShape *each : shapes_of(*body)) shapes[size_t(intptr_t(each->userData))].born = steps;
            if (value[0] == 0.0f) {
                if (actor->frozen) body->setAngularVelocity(without_frozen(*actor, body->getAngularVelocity()));
                body->wakeUp();
            }
            marks[command.actor] |= PLACED;
            break;
        }
        case PHYSICS_GRAVITY: body->setActorFlag(PxActorFlag::eDISABLE_GRAVITY, value[0] == 0.0f); break;
        case PHYSICS_DAMPING:
            body->setLinearDamping(std::max(0.0f, value[0]));
            body->setAngularDamping(std::max(0.0f, value[1]));
            break;
        case PHYSICS_LIMITS:
            body->setMaxLinearVelocity(std::max(0.0f, value[0]));
            body->setMaxAngularVelocity(std::max(0.0f, value[1]));
            body->setMaxDepenetrationVelocity(std::max(1e-3f, value[2]));
            break;
        case PHYSICS_FREEZE:
            body->setRigidDynamicLockFlags(PxRigidDynamicLockFlags(PxU8(PxU8(value[0]) & 7)));
            actor->frozen = PxU8(value[0]) >> 3;
            mass_changed(*actor);
            if (!kinematic && actor->frozen) body->setAngularVelocity(without_frozen(*actor, body->getAngularVelocity()), false);
            break;
        case PHYSICS_MASS:
            actor->mass = std::max(1e-7f, value[0]);
            mass_changed(*actor);
            break;
        case PHYSICS_MASS_CENTER:
            actor->own_center = value[3] != 0.0f;
            actor->center = vector;
            mass_changed(*actor);
            break;
        case PHYSICS_INERTIA:
            actor->inertia = vector;
            actor->inertia_rotation = PxQuat(value[3], value[4], value[5], value[6]);
            actor->own_inertia = actor->inertia_rotation.normalize() > 0.0f;
            mass_changed(*actor);
            break;
        case PHYSICS_SLEEP_BELOW: body->setSleepThreshold(std::max(0.0f, value[0])); break;
        case PHYSICS_ITERATIONS:
            body->setSolverIterationCounts(PxU32(std::min(255.0f, std::max(1.0f, value[0]))),
                                           PxU32(std::min(255.0f, std::max(0.0f, value[1]))));
            break;
        case PHYSICS_DETECTION:
            body->setRigidBodyFlag(PxRigidBodyFlag::eENABLE_CCD,
                                   !kinematic && (value[0] == PHYSICS_CONTINUOUS || value[0] == PHYSICS_CONTINUOUS_DYNAMIC));
            body->setRigidBodyFlag(PxRigidBodyFlag::eENABLE_SPECULATIVE_CCD, value[0] == PHYSICS_SPECULATIVE);
            break;
    }
}

void physics_world::apply_all(const physics_command *commands, int32_t count) {
    for (int32_t index = 0; index < count; index++) {
        const Actor *next = index + AHEAD < count ? actor(commands[index + AHEAD].actor) : nullptr;
        if (next) prefetch(next->rigid);
        apply(commands[index]);
    }
}

// Returns whether more pairs of bounds overlap than fit into memory. Sweeps the bounds along x, up to a limit of tested pairs.
bool physics_world::crowded() {
    struct Box {
        PxBounds3 bounds;
        bool moves;
    };
    std::vector<Box> boxes;
    boxes.reserve(shapes.size());
    for (const Shape &each : shapes) {
        if (!each.shape) continue;
        PxRigidActor &rigid = *actors[each.actor].rigid;
        Box box;
        PxGeometryQuery::computeGeomBounds(box.bounds, each.shape->getGeometry(), PxShapeExt::getGlobalPose(*each.shape, rigid));
        box.moves = rigid.is<PxRigidDynamic>() != nullptr;
        boxes.push_back(box);
    }
    std::sort(boxes.begin(), boxes.end(), [](const Box &a, const Box &b) { return a.bounds.minimum.x < b.bounds.minimum.x; });
    uint64_t pairs = 0, looked = 0;
    for (size_t index = 0; index < boxes.size(); index++)
        for (size_t next = index + 1; next < boxes.size() && boxes[next].bounds.minimum.x <= boxes[index].bounds.maximum.x; next++) {
            if (++looked > 400 * MAX_PAIRS) return false; // too many pairs to test, but probably not one heap
            if ((boxes[index].moves || boxes[next].moves) && boxes[index].bounds.intersects(boxes[next].bounds) && ++pairs > MAX_PAIRS)
                return true;
        }
    return false;
}

void physics_world::onSleep(PxActor **sleepers, PxU32 count) {
    for (PxU32 index = 0; index < count; index++) marks[size_t(intptr_t(sleepers[index]->userData))] |= MOVED;
}

void physics_world::add_touch(int32_t a, int32_t b, int32_t phase, bool trigger) {
    physics_touch touch = {};
    touch.a = a;
    touch.b = b;
    touch.phase = phase;
    touch.trigger = trigger;
    touch.first_contact = int32_t(contacts.size());
    touches.push_back(touch);
}

void physics_world::onContact(const PxContactPairHeader &header, const PxContactPair *pairs, PxU32 count) {
    if (header.flags & (PxContactPairHeaderFlag::eREMOVED_ACTOR_0 | PxContactPairHeaderFlag::eREMOVED_ACTOR_1)) return;
    PxVec3 relative(0.0f);
    PxContactPairExtraDataIterator extra(header.extraDataStream, header.extraDataStreamSize);
    if (extra.nextItemSet() && extra.preSolverVelocity)
        relative = extra.preSolverVelocity->linearVelocity[1] - extra.preSolverVelocity->linearVelocity[0];
    PxContactPairPoint points[64];
    for (PxU32 index = 0; index < count; index++) {
        const PxContactPair &pair = pairs[index];
        if (pair.flags & (PxContactPairFlag::eREMOVED_SHAPE_0 | PxContactPairFlag::eREMOVED_SHAPE_1)) continue;
        const int32_t a = int32_t(intptr_t(pair.shapes[0]->userData)), b = int32_t(intptr_t(pair.shapes[1]->userData));
        const bool flip = shapes[a].identity > shapes[b].identity;
        int32_t phase = pair.events & PxPairFlag::eNOTIFY_TOUCH_LOST    ? PHYSICS_EXIT
                        : pair.events & PxPairFlag::eNOTIFY_TOUCH_FOUND ? PHYSICS_ENTER
                                                                        : PHYSICS_STAY;
        if (phase == PHYSICS_ENTER && resumed.count(Ignored::key(shapes[a].identity, shapes[b].identity))) phase = PHYSICS_STAY;
        add_touch(flip ? b : a, flip ? a : b, phase, false);
        if (phase == PHYSICS_EXIT) continue;
        physics_touch &touch = touches.back();
        const float sign = flip ? -1.0f : 1.0f;
        touch.relative_velocity = vec(relative * sign);
        const PxU32 found = pair.extractContacts(points, 64);
        for (PxU32 contact = 0; contact < found; contact++) {
            const PxContactPairPoint &point = points[contact];
            contacts.push_back({vec(point.position), vec(point.normal * sign), vec(point.impulse * sign), point.separation});
        }
        touch.contact_count = int32_t(found);
    }
}

// Collects the contacts of the last step that continue although PhysX filters them again.
void physics_world::resume_contacts() {
    resumed.clear();
    if (!resumes) return;
    resumes = false;
    for (const physics_touch &touch : touches) {
        const Shape &a = shapes[touch.a], &b = shapes[touch.b];
        if (!touch.trigger && touch.phase != PHYSICS_EXIT && a.shape && b.shape && a.born != steps && b.born != steps)
            resumed.insert(Ignored::key(a.identity, b.identity));
    }
}

static bool is_kinematic(const PxActor *actor) {
    return static_cast<const PxRigidDynamic *>(actor)->getRigidBodyFlags() & PxRigidBodyFlag::eKINEMATIC;
}

PxFilterFlags physics_world::pairFound(PxU32 pair, PxFilterObjectAttributes, PxFilterData data0, const PxActor *actor0,
                                       const PxShape *shape0, PxFilterObjectAttributes, PxFilterData data1, const PxActor *actor1,
                                       const PxShape *shape1, PxPairFlags &) {
    if (!((data0.word0 | data1.word0) & TRIGGER))
        return is_kinematic(actor0) && is_kinematic(actor1) ? PxFilterFlag::eSUPPRESS : PxFilterFlag::eDEFAULT;
    if (overlaps.size() <= pair) overlaps.resize(std::max<size_t>(pair + 1, 2 * overlaps.size()));
    Overlap &overlap = overlaps[pair];
    overlap = Overlap();
    overlap.a = int32_t(intptr_t(shape0->userData));
    overlap.b = int32_t(intptr_t(shape1->userData));
    if (data0.word1 > data1.word1) std::swap(overlap.a, overlap.b);
    const auto known = lost_overlaps.find(Ignored::key(data0.word1, data1.word1));
    if (known != lost_overlaps.end() && !known->second.ends) {
        overlap.touching = true;
        lost_overlaps.erase(known);
    }
    return PxFilterFlag::eNOTIFY | PxFilterFlag::eSUPPRESS;
}

void physics_world::pairLost(PxU32 pair, PxFilterObjectAttributes, PxFilterData data0, PxFilterObjectAttributes, PxFilterData data1,
                             bool removed) {
    Overlap &overlap = overlaps[pair];
    if (overlap.touching && (!removed || removal != REMOVED))
        lost_overlaps[Ignored::key(data0.word1, data1.word1)] = {overlap.a, overlap.b, removal == ENDS};
    overlap = Overlap();
}

void physics_world::collect_overlaps() {
    for (const auto &entry : lost_overlaps) add_touch(entry.second.a, entry.second.b, PHYSICS_EXIT, true);
    lost_overlaps.clear();
    for (Overlap &overlap : overlaps) {
        if (overlap.a == PHYSICS_NONE) continue;
        const Shape &a = shapes[overlap.a], &b = shapes[overlap.b];
        const Actor &actor_a = actors[a.actor], &actor_b = actors[b.actor];
        const bool was = overlap.touching;
        if (!overlap.tested || is_active(a.actor) || is_active(b.actor)) {
            // Like PhysX's contacts, overlaps are those of the poses before the step.
            const PxTransform at_a = actor_a.last_pose * a.shape->getLocalPose(), at_b = actor_b.last_pose * b.shape->getLocalPose();
            const PxGeometry &first = a.shape->getGeometry(), &second = b.shape->getGeometry();
            if (first.getType() == PxGeometryType::eSPHERE && second.getType() == PxGeometryType::eSPHERE)
                overlap.touching = spheres_overlap(static_cast<const PxSphereGeometry &>(first), at_a.p,
                                                   static_cast<const PxSphereGeometry &>(second), at_b.p);
            else
                overlap.touching = PxGeometryQuery::overlap(first, at_a, second, at_b);
            overlap.tested = true;
        }
        if (overlap.touching)
            add_touch(overlap.a, overlap.b, was ? PHYSICS_STAY : PHYSICS_ENTER, true);
        else if (was)
            add_touch(overlap.a, overlap.b, PHYSICS_EXIT, true);
    }
}

void physics_world::collect_motions(int32_t step, physics_motion *motions) {
    PxU32 count = 0;
    PxActor **active = scene->getActiveActors(count);
    for (PxU32 index = 0; index < count; index++) {
        if (index + PxU32(AHEAD) < count) __builtin_prefetch(&active[index + PxU32(AHEAD)]->userData);
        marks[size_t(intptr_t(active[index]->userData))] |= MOVED;
    }
    moved.clear();
    for (size_t handle = 0; handle < marks.size(); handle++) {
        if (marks[handle] & MOVED) {
            // A led body keeps the caller's pose. PhysX's pose differs by rounding.
            if (actors[handle].led)
                motions[handle].velocity = motions[handle].spin = {0.0f, 0.0f, 0.0f};
            else
                moved.push_back(int32_t(handle));
        }
        marks[handle] = marks[handle] & MOVED ? MOVED_BEFORE : 0;
    }
    std::atomic<bool> infinite{false};
    workers.each(int(moved.size()), [this, step, motions, &infinite](int first, int end) {
        for (int index = first; index < end; index++) {
            if (index + AHEAD < end) prefetch(actors[moved[index + AHEAD]].rigid);
            Actor &actor = actors[moved[index]];
            const PxRigidDynamic &body = *actor.body();
            physics_motion &motion = motions[moved[index]];
            motion.step = step;
            motion.asleep = body.isSleeping() && !(body.getRigidBodyFlags() & PxRigidBodyFlag::eKINEMATIC);
            const PxTransform at = body.getGlobalPose();
            motion.pose = pose(at);
            motion.velocity = vec(body.getLinearVelocity());
            motion.spin = vec(body.getAngularVelocity());
            if (is_finite(motion))
                actor.last_pose = at;
            else
                infinite = true;
        }
    });
    if (infinite)
        for (const int32_t handle : moved)
            if (!is_finite(motions[handle])) reset_body(handle, motions[handle]);
}

void physics_world::reset_body(int32_t handle, physics_motion &motion) {
    const Actor &actor = actors[handle];
    PxRigidDynamic &body = *actor.body();
    fail("A body's motion became infinite: it was reset to its last pose and stopped.");
    body.setGlobalPose(actor.last_pose);
    if (!(body.getRigidBodyFlags() & PxRigidBodyFlag::eKINEMATIC)) {
        body.setLinearVelocity(PxVec3(0.0f));
        body.setAngularVelocity(PxVec3(0.0f));
    }
    motion.pose = pose(actor.last_pose);
    motion.velocity = motion.spin = {0.0f, 0.0f, 0.0f};
}

extern "C" {

void physics_apply(physics_world *world, const physics_command *commands, int32_t count) { world->apply_all(commands, count); }

int32_t physics_step(physics_world *world, const physics_command *commands, int32_t count, float seconds, const physics_vector *gravity,
                     int32_t number, physics_motion *motions, physics_result *result) {
    *result = {};
    world->apply_all(commands, count);
    if (world->masses_stale)
        for (Actor &actor : world->actors)
            if (actor.mass_stale) world->refresh_mass(actor);
    world->masses_stale = false;
    if (world->placed > FEW_PLACED && world->crowded()) {
        fail("More than " + std::to_string(MAX_PAIRS) +
             " pairs of colliders overlap in one place: the physics step was skipped. Spread the objects out.");
        return 0;
    }
    world->placed = 0;
    world->filter_joined();
    world->resume_contacts();
    world->steps++;
    world->touches.clear();
    world->contacts.clear();
    world->broken.clear();
    world->scene->setGravity(vec(*gravity));
    Finish finish(*world);
    world->scene->simulate(seconds, &finish);
    finish.removeReference();
    world->workers.work_until(finish.over);
    world->scene->fetchResults(true);
    world->collect_overlaps();
    world->collect_motions(number, motions);
    std::sort(world->touches.begin(), world->touches.end(), [world](const physics_touch &a, const physics_touch &b) {
        const uint32_t a0 = world->shapes[a.a].identity, b0 = world->shapes[b.a].identity;
        if (a0 != b0) return a0 < b0;
        const uint32_t a1 = world->shapes[a.b].identity, b1 = world->shapes[b.b].identity;
        // A pair has two touches if a body becomes kinematic or dynamic inside a trigger. The exit is first.
        return a1 != b1 ? a1 < b1 : a.phase > b.phase;
    });
    for (physics_break &broken : world->broken) {
        PxVec3 force, torque;
        world->joints[broken.joint].joint->getConstraint()->getForce(force, torque);
        broken.force = force.magnitude();
        world->drop_joint(broken.joint);
    }
    *result = {world->touches.data(),          world->contacts.data(),          world->broken.data(),
               int32_t(world->touches.size()), int32_t(world->contacts.size()), int32_t(world->broken.size())};
    return 1;
}

} // extern "C"
