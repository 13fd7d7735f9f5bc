// Rays, sweeps, overlaps, nearest points.
#include <algorithm>

#include "world.hpp"

using namespace collektive;

namespace {

const float FARTHEST = 1e8f; // metres, the limit of PhysX for sweeps
const PxHitFlags HIT = PxHitFlag::ePOSITION | PxHitFlag::eNORMAL;
const PxHitFlags SWEEP = HIT | PxHitFlag::ePRECISE_SWEEP;

PxHitFlags ray_flags(const physics_filter &filter) {
    PxHitFlags flags = HIT;
    if (filter.faces & PHYSICS_BACK_FACES) flags |= PxHitFlag::eMESH_BOTH_SIDES;
    if (filter.faces & PHYSICS_ALL_FACES) flags |= PxHitFlag::eMESH_MULTIPLE;
    return flags;
}

// Ignores shapes that contain the start of a ray or sweep, and one actor. With eNO_BLOCK, PhysX keeps hits that postFilter ignores, so
// `found` is a touch for queries that request all hits.
struct Outside final : PxQueryFilterCallback {
    const PxRigidActor *self = nullptr;
    PxQueryHitType::Enum found = PxQueryHitType::eBLOCK;

    PxQueryHitType::Enum preFilter(const PxFilterData &, const PxShape *, const PxRigidActor *actor, PxHitFlags &) override {
        return actor == self ? PxQueryHitType::eNONE : found;
    }
    PxQueryHitType::Enum postFilter(const PxFilterData &, const PxQueryHit &hit, const PxShape *, const PxRigidActor *) override {
        return static_cast<const PxLocationHit &>(hit).hadInitialOverlap() ? PxQueryHitType::eNONE : found;
    }
};

// Returns the index that the hit triangle had before cooking, which reorders triangles.
int32_t triangle(const PxLocationHit &hit, const PxGeometry &geometry) {
    if (geometry.getType() != PxGeometryType::eTRIANGLEMESH) return PHYSICS_NONE;
    const PxTriangleMesh &mesh = *static_cast<const PxTriangleMeshGeometry &>(geometry).triangleMesh;
    return hit.faceIndex < mesh.getNbTriangles() ? int32_t(mesh.getTrianglesRemap()[hit.faceIndex]) : PHYSICS_NONE;
}

physics_hit to_hit(const PxLocationHit &from, const PxShape &shape) {
    // PhysX sets no position for an overlap at the start of a sweep.
    return {int32_t(intptr_t(shape.userData)), triangle(from, shape.getGeometry()),
            from.hadInitialOverlap() ? physics_vector{0, 0, 0} : vec(from.position), vec(from.normal), from.distance};
}

template <typename Hit> physics_hit to_hit(const Hit &from) { return to_hit(from, *from.shape); }

const physics_hit NOTHING = {PHYSICS_NONE, PHYSICS_NONE, {0, 0, 0}, {0, 0, 0}, 0};

template <typename Hit> Hit *room(int32_t capacity) {
    static thread_local std::vector<Hit> hits;
    if (hits.size() < size_t(capacity)) hits.resize(size_t(capacity));
    return hits.data();
}

const PxQueryFlags ALL = PxQueryFlag::eSTATIC | PxQueryFlag::eDYNAMIC;

int32_t sweep(physics_world *world, const PxGeometry &geometry, const PxTransform &from, const PxVec3 &direction, float distance,
              const physics_filter &filter, const PxRigidActor *self, physics_hit *hits, int32_t capacity) {
    Outside outside;
    outside.self = self;
    const PxQueryFlags flags = ALL | (self ? PxQueryFlag::ePREFILTER : PxQueryFlag::Enum(0));
    distance = std::min(distance, FARTHEST);
    if (capacity == 0) {
        PxSweepBuffer found;
        if (!world->scene->sweep(geometry, from, direction, distance, found, SWEEP, query_filter(filter, flags | PxQueryFlag::ePOSTFILTER),
                                 &outside))
            return 0;
        hits[0] = to_hit(found.block);
        return 1;
    }
    PxSweepBuffer found(room<PxSweepHit>(capacity), PxU32(capacity));
    world->scene->sweep(geometry, from, direction, distance, found, SWEEP, query_filter(filter, flags | PxQueryFlag::eNO_BLOCK), &outside);
    for (PxU32 index = 0; index < found.nbTouches; index++) hits[index] = to_hit(found.touches[index]);
    return int32_t(found.nbTouches);
}

} // namespace

PxQueryFilterData collektive::query_filter(const physics_filter &filter, PxQueryFlags flags) {
    PxQueryFilterData data;
    data.data.word0 = filter.layers;
    data.data.word1 = filter.triggers ? filter.layers : 0;
    // PhysX reads words of 0 as "everything".
    data.data.word2 = 1;
    data.flags = flags;
    return data;
}

extern "C" {

void physics_raycast(physics_world *world, const physics_ray *rays, const physics_filter *filters, int32_t count, physics_hit *hits) {
    world->scene->flushQueryUpdates();
    world->workers.each(count, [=](int first, int end) {
        Outside outside;
        for (int index = first; index < end; index++) {
            const physics_ray &ray = rays[index];
            PxRaycastBuffer found;
            const physics_filter &filter = filters[index];
            const bool hit = world->scene->raycast(vec(ray.origin), vec(ray.direction), std::min(ray.distance, FARTHEST), found,
                                                   ray_flags(filter), query_filter(filter, ALL | PxQueryFlag::ePOSTFILTER), &outside);
            hits[index] = hit ? to_hit(found.block) : NOTHING;
        }
    });
}

int32_t physics_raycast_all(physics_world *world, const physics_ray *ray, const physics_filter *filter, physics_hit *hits,
                            int32_t capacity) {
    Outside outside;
    outside.found = PxQueryHitType::eTOUCH;
    PxRaycastBuffer found(room<PxRaycastHit>(capacity), PxU32(capacity));
    world->scene->raycast(vec(ray->origin), vec(ray->direction), std::min(ray->distance, FARTHEST), found, ray_flags(*filter),
                          query_filter(*filter, ALL | PxQueryFlag::ePOSTFILTER), &outside);
    for (PxU32 index = 0; index < found.nbTouches; index++) hits[index] = to_hit(found.touches[index]);
    return int32_t(found.nbTouches);
}

int32_t physics_raycast_shape(physics_world *world, int32_t handle, const physics_ray *ray, physics_hit *hit) {
    *hit = NOTHING;
    Shape *shape = world->shape(handle);
    if (!shape) return 0;
    PxGeomRaycastHit found;
    if (!PxGeometryQuery::raycast(vec(ray->origin), vec(ray->direction), shape->shape->getGeometry(),
                                  PxShapeExt::getGlobalPose(*shape->shape, *world->actors[shape->actor].rigid),
                                  std::min(ray->distance, FARTHEST), HIT, 1, &found) ||
        found.hadInitialOverlap())
        return 0;
    *hit = to_hit(found, *shape->shape);
    return 1;
}

int32_t physics_overlap(physics_world *world, const physics_geometry *geometry, const physics_pose *at, const physics_filter *filter,
                        int32_t *shapes, int32_t capacity) {
    PxGeometryHolder holder;
    if (!make_geometry(*geometry, holder)) return 0;
    PxOverlapBuffer found(room<PxOverlapHit>(capacity), PxU32(capacity));
    world->scene->overlap(holder.any(), pose(*at), found, query_filter(*filter, ALL | PxQueryFlag::eNO_BLOCK));
    for (PxU32 index = 0; index < found.nbTouches; index++) shapes[index] = int32_t(intptr_t(found.touches[index].shape->userData));
    return int32_t(found.nbTouches);
}

void physics_begin_overlaps(physics_world *world, const physics_sphere *spheres, const physics_filter *filters, int32_t count,
                            int32_t *shapes, int32_t capacity) {
    world->scene->flushQueryUpdates();
    world->workers.begin(count, [=](int first, int end) {
        for (int index = first; index < end; index++) {
            int32_t *own = shapes + size_t(index) * size_t(capacity);
            PxOverlapBuffer found(room<PxOverlapHit>(capacity), PxU32(capacity));
            world->scene->overlap(PxSphereGeometry(std::max(spheres[index].radius, 1e-4f)), PxTransform(vec(spheres[index].centre)), found,
                                  query_filter(filters[index], ALL | PxQueryFlag::eNO_BLOCK));
            for (PxU32 hit = 0; hit < found.nbTouches; hit++) own[hit] = int32_t(intptr_t(found.touches[hit].shape->userData));
            if (int32_t(found.nbTouches) < capacity) own[found.nbTouches] = PHYSICS_NONE;
        }
    });
}

void physics_finish_overlaps(physics_world *world) { world->workers.finish(); }

int32_t physics_sweep(physics_world *world, const physics_geometry *geometry, const physics_pose *at, const physics_vector *direction,
                      float distance, const physics_filter *filter, physics_hit *hits, int32_t capacity) {
    PxGeometryHolder holder;
    if (!make_geometry(*geometry, holder)) return 0;
    return sweep(world, holder.any(), pose(*at), vec(*direction), distance, *filter, nullptr, hits, capacity);
}

int32_t physics_sweep_actor(physics_world *world, int32_t handle, const physics_vector *direction, float distance, int32_t triggers,
                            physics_hit *hits, int32_t capacity) {
    Actor *actor = world->actor(handle);
    if (!actor) return 0;
    const physics_filter filter = {~0u, triggers, 0};
    int32_t count = 0;
    for (PxShape *each : shapes_of(*actor->rigid)) {
        if (each->getQueryFilterData().word0 == 0 || each->getGeometry().getType() == PxGeometryType::eTRIANGLEMESH) continue;
        const PxTransform from = PxShapeExt::getGlobalPose(*each, *actor->rigid);
        if (capacity > 0) {
            if (count < capacity)
                count += sweep(world, each->getGeometry(), from, vec(*direction), distance, filter, actor->rigid, hits + count,
                               capacity - count);
            continue;
        }
        physics_hit nearer;
        if (sweep(world, each->getGeometry(), from, vec(*direction), distance, filter, actor->rigid, &nearer, 0) &&
            (count == 0 || nearer.distance < hits[0].distance)) {
            hits[0] = nearer;
            count = 1;
        }
    }
    return count;
}

void physics_closest_point(physics_world *world, int32_t handle, const physics_pose *at, const physics_vector *point,
                           physics_vector *closest) {
    *closest = *point;
    Shape *shape = world->shape(handle);
    if (!shape) return;
    const PxGeometry &geometry = shape->shape->getGeometry();
    if (geometry.getType() == PxGeometryType::eTRIANGLEMESH) return;
    const PxTransform place = at ? pose(*at) : PxShapeExt::getGlobalPose(*shape->shape, *world->actors[shape->actor].rigid);
    PxVec3 found;
    if (PxGeometryQuery::pointDistance(vec(*point), geometry, place, &found) > 0.0f) *closest = vec(found);
}

int32_t physics_penetration(physics_world *world, int32_t handle, const physics_pose *at, int32_t other_handle,
                            const physics_pose *other_at, physics_vector *direction, float *distance) {
    *direction = {0.0f, 0.0f, 0.0f};
    *distance = 0.0f;
    Shape *shape = world->shape(handle), *other = world->shape(other_handle);
    if (!shape || !other) return 0;
    const PxGeometry &first = shape->shape->getGeometry(), &second = other->shape->getGeometry();
    if (first.getType() == PxGeometryType::eTRIANGLEMESH && second.getType() == PxGeometryType::eTRIANGLEMESH) return 0;
    PxVec3 way;
    if (!PxGeometryQuery::computePenetration(way, *distance, first, pose(*at), second, pose(*other_at))) return 0;
    *direction = vec(way);
    return 1;
}

} // extern "C"
