// Cooking of convex and concave meshes.
#include "world.hpp"

#include <cmath>

using namespace collektive;

extern "C" {

physics_mesh *physics_mesh_create(const physics_vector *points, int32_t point_count, const int32_t *indices, int32_t index_count,
                                  int32_t convex) {
    for (int32_t index = 0; index < point_count; index++)
        if (!std::isfinite(points[index].x + points[index].y + points[index].z)) {
            fail("A mesh has a point that is not finite.");
            return nullptr;
        }
    for (int32_t index = 0; index < index_count; index++)
        if (indices[index] < 0 || indices[index] >= point_count) {
            fail("A triangle of a mesh has a vertex index out of range.");
            return nullptr;
        }
    PxPhysics &engine = physics();
    PxCookingParams parameters(engine.getTolerancesScale());
    PxRefCounted *made = nullptr;
    if (convex) {
        PxConvexMeshDesc description;
        description.points.count = PxU32(point_count);
        description.points.stride = sizeof(physics_vector);
        description.points.data = points;
        description.flags = PxConvexFlag::eCOMPUTE_CONVEX | PxConvexFlag::eSHIFT_VERTICES;
        description.vertexLimit = 255;
        if (description.isValid()) made = PxCreateConvexMesh(parameters, description, engine.getPhysicsInsertionCallback());
        if (!made) fail("No convex hull encloses the mesh: it needs four points that do not lie in a plane.");
    } else {
        PxTriangleMeshDesc description;
        description.points.count = PxU32(point_count);
        description.points.stride = sizeof(physics_vector);
        description.points.data = points;
        description.triangles.count = PxU32(index_count / 3);
        description.triangles.stride = 3 * sizeof(int32_t);
        description.triangles.data = indices;
        parameters.midphaseDesc = PxMeshMidPhase::eBVH34;
        if (description.isValid()) made = PxCreateTriangleMesh(parameters, description, engine.getPhysicsInsertionCallback());
        if (!made) fail("The mesh has no valid triangles.");
    }
    return made ? new physics_mesh{made, convex != 0} : nullptr;
}

void physics_mesh_release(physics_mesh *mesh) {
    if (!mesh) return;
    mesh->base->release();
    delete mesh;
}

} // extern "C"
