// Jolt as its user built it. The shape is cast against the mesh alone, without a body or a system around it. Both
// sides of a triangle are solid, and only the nearest hit is wanted.

#include <Jolt/Physics/Collision/CastResult.h>
#include <Jolt/Physics/Collision/CollisionCollectorImpl.h>
#include <Jolt/Physics/Collision/CollisionDispatch.h>
#include <Jolt/Physics/Collision/RayCast.h>
#include <Jolt/Physics/Collision/Shape/CapsuleShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/Collision/ShapeCast.h>

#include "engine.h"
#include "jolt_mesh.h"
#include "memory.h"

namespace roam::bench {
namespace {

Answer cast(const JPH::Shape& mesh, JPH::Shape&& body, JPH::QuatArg pose, const Query& query) {
  body.SetEmbedded();  // on the stack
  JPH::ShapeCastSettings settings;
  settings.SetBackFaceMode(JPH::EBackFaceMode::CollideWithBackFaces);
  const JPH::Vec3 whole = JPH::Vec3::sReplicate(1.0F);
  const JPH::ShapeCast motion(&body, whole, JPH::Mat44::sRotationTranslation(pose, to_jolt(query.from)),
                              to_jolt(query.motion));
  JPH::ClosestHitCollisionCollector<JPH::CastShapeCollector> first;
  JPH::CollisionDispatch::sCastShapeVsShapeLocalSpace(motion, settings, &mesh, whole, {}, JPH::Mat44::sIdentity(), {},
                                                      {}, first);
  return first.HadHit() ? Answer{true, first.mHit.mFraction} : Answer{};
}

Answer ray(const JPH::Shape& mesh, const Query& query) {
  JPH::RayCastResult first;
  const bool hit = mesh.CastRay({to_jolt(query.from), to_jolt(query.motion)}, {}, first);
  return hit ? Answer{true, first.mFraction} : Answer{};
}

}  // namespace

Engine make_jolt(const Scene& scene) {
  Engine engine{.name = "Jolt " + jolt_version(),
                .used = "CastShape against a MeshShape, 4 triangles a leaf, floats; rays: CastRay",
                .rays = true};
  const std::size_t before = allocated_bytes();
  JPH::RefConst<JPH::Shape> mesh;
  engine.build_one = seconds([&] { mesh = jolt_mesh(FloatMesh(scene)); });
  engine.bytes = allocated_bytes() - before;
  engine.ask = timed([mesh](const Query& query) {
    if (query.body.radius == 0) return ray(*mesh, query);
    const auto radius = static_cast<float>(query.body.radius);
    if (query.body.half_height == 0) return cast(*mesh, JPH::SphereShape(radius), JPH::Quat::sIdentity(), query);
    return cast(*mesh, JPH::CapsuleShape(static_cast<float>(query.body.half_height), radius), upright(), query);
  });
  return engine;
}

}  // namespace roam::bench
