// Embree has no sweep. Its point query visits the triangles near a place. So a sweep is a row of point queries along
// the motion, each for a stretch of a few radii. A sphere test in doubles decides the visited triangles. The row stops
// at the first stretch that begins behind the first touch so far. Rays and nearest points are Embree's own, in floats.

#if ROAM_BENCH_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>

#include "closed_form.h"
#include "engine.h"
#include "float_mesh.h"
#include "roam/error.h"

namespace roam::bench {
namespace {

bool count_bytes(void* bytes, ssize_t change, bool) {
  *static_cast<ssize_t*>(bytes) += change;
  return true;
}

struct EmbreeWorld {
  EmbreeWorld(const Scene& from, int threads) {  // 1 or 2
    device = rtcNewDevice(threads == 1 ? "threads=1" : "threads=2");
    if (device == nullptr) throw Error("Embree gives no device");
    rtcSetDeviceMemoryMonitorFunction(device, count_bytes, &bytes);
    const FloatMesh mesh(from);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                           3 * sizeof(float), mesh.vertices.size() / 3));
    indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                  3 * sizeof(std::uint32_t), mesh.indices.size() / 3));
    std::copy(mesh.vertices.begin(), mesh.vertices.end(), vertices);
    std::copy(mesh.indices.begin(), mesh.indices.end(), indices);
    rtcCommitGeometry(geometry);
    scene = rtcNewScene(device);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
  }
  ~EmbreeWorld() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  EmbreeWorld(const EmbreeWorld&) = delete;
  EmbreeWorld& operator=(const EmbreeWorld&) = delete;

  ssize_t bytes = 0;  // before the device, whose last words go to it
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  float* vertices = nullptr;
  std::uint32_t* indices = nullptr;
};

struct Visit {
  const EmbreeWorld* world;
  const Query* query;
  double first;                       // touch so far, as a fraction of the motion; more than 1 if there is none
  std::array<float, 3> lower, upper;  // box of the body's sweep until then, rounded outwards
};

void bound(Visit& state) {
  const Query& query = *state.query;
  constexpr float outwards = std::numeric_limits<float>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double grown = query.body.radius + (k == 2 ? query.body.half_height : 0.0);
    const double end = query.from[k] + std::min(state.first, 1.0) * query.motion[k];
    state.lower[k] = std::nextafter(static_cast<float>(std::min(query.from[k], end) - grown), -outwards);
    state.upper[k] = std::nextafter(static_cast<float>(std::max(query.from[k], end) + grown), outwards);
  }
}

bool visit(RTCPointQueryFunctionArguments* arguments) {
  Visit& state = *static_cast<Visit*>(arguments->userPtr);
  const Query& query = *state.query;
  const std::uint32_t* index = state.world->indices + 3 * arguments->primID;
  const float* a = state.world->vertices + 3 * index[0];
  const float* b = state.world->vertices + 3 * index[1];
  const float* c = state.world->vertices + 3 * index[2];
  for (int k = 0; k < 3; ++k) {
    if (std::max({a[k], b[k], c[k]}) < state.lower[k] || std::min({a[k], b[k], c[k]}) > state.upper[k]) return false;
  }
  const Corners<double> corner{Vec3(a[0], a[1], a[2]) - query.from, Vec3(b[0], b[1], b[2]) - query.from,
                               Vec3(c[0], c[1], c[2]) - query.from};
  // The whole motion is on one side of the triangle's plane, farther off than the body reaches.
  const Vec3 n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double from = -glm::dot(n, corner[0]);
  const double to = from + std::min(state.first, 1.0) * glm::dot(n, query.motion);
  const double reach = query.body.radius * glm::length(n) + query.body.half_height * std::abs(n.z);
  if (std::min(from, to) > reach || std::max(from, to) < -reach) return false;
  const double before = state.first;
  extrude(corner, query.body.half_height, [&](const Corners<double>& part) {
    state.first = time_of_impact(part, query.motion, query.body.radius, state.first);
  });
  if (state.first < before) bound(state);
  return false;  // the search domain stays as it is
}

Answer sweep(const EmbreeWorld& world, const Query& query) {
  constexpr double behind_end = 2;
  constexpr double shortest_reach = 0.05;  // m: a point as body would need infinitely many stretches
  const double length = glm::length(query.motion);
  // One body's width: the fastest of 1 to 8 radii, with and without a least length, over all sets.
  const double reach = query.body.radius + query.body.half_height;
  const int stretches = std::max(1, static_cast<int>(std::ceil(length / (2 * std::max(reach, shortest_reach)))));
  Visit state{&world, &query, behind_end, {}, {}};
  bound(state);
  for (int i = 0; i < stretches && state.first > static_cast<double>(i) / stretches; ++i) {
    const Vec3 middle = query.from + ((i + 0.5) / stretches) * query.motion;
    RTCPointQuery point{static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z), 0,
                        static_cast<float>(0.5 * length / stretches + reach)};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(world.scene, &point, &context, visit, &state);
  }
  return {state.first <= 1, std::min(state.first, 1.0)};
}

Answer ray(const EmbreeWorld& world, const Query& query) {
  RTCRayHit hit{};
  hit.ray.org_x = static_cast<float>(query.from.x);
  hit.ray.org_y = static_cast<float>(query.from.y);
  hit.ray.org_z = static_cast<float>(query.from.z);
  hit.ray.dir_x = static_cast<float>(query.motion.x);
  hit.ray.dir_y = static_cast<float>(query.motion.y);
  hit.ray.dir_z = static_cast<float>(query.motion.z);
  hit.ray.tfar = 1;
  hit.ray.mask = ~0U;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if ROAM_BENCH_EMBREE >= 4
  rtcIntersect1(world.scene, &hit);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(world.scene, &context, &hit);
#endif
  return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? Answer{} : Answer{true, hit.ray.tfar};
}

bool visit_nearest(RTCPointQueryFunctionArguments* arguments) {
  const EmbreeWorld& world = *static_cast<const EmbreeWorld*>(arguments->userPtr);
  const std::uint32_t* index = world.indices + 3 * arguments->primID;
  const Point<float> from{arguments->query->x, arguments->query->y, arguments->query->z};
  Corners<float> corner;
  for (std::size_t i = 0; i < 3; ++i) {
    const float* v = world.vertices + 3 * index[i];
    corner[i] = Point<float>(v[0], v[1], v[2]) - from;
  }
  const float distance = glm::length(nearest_to_origin(corner));
  if (!(distance < arguments->query->radius)) return false;
  arguments->query->radius = distance;
  return true;  // the search domain shrinks
}

Answer nearest(const EmbreeWorld& world, const Query& query) {
  RTCPointQuery point{static_cast<float>(query.from.x), static_cast<float>(query.from.y),
                      static_cast<float>(query.from.z), 0, static_cast<float>(nearest_reach)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(world.scene, &point, &context, visit_nearest, const_cast<EmbreeWorld*>(&world));
  return {.distance = point.radius};
}

}  // namespace

Engine make_embree(const Scene& scene) {
  Engine engine{.name = "Embree",
                .used = "rtcPointQuery and a sphere test in doubles; rays: rtcIntersect1; nearest: floats",
                .rays = true};
  engine.build_one = seconds([&] { const EmbreeWorld world(scene, 1); });
  std::shared_ptr<EmbreeWorld> world;
  engine.build_two = seconds([&] { world = std::make_shared<EmbreeWorld>(scene, 2); });
  engine.bytes = static_cast<std::size_t>(world->bytes);
  const auto version = rtcGetDeviceProperty(world->device, RTC_DEVICE_PROPERTY_VERSION);  // 31305 is 3.13.5
  engine.name.append(1, ' ').append(std::to_string(version / 10000));
  engine.name.append(1, '.').append(std::to_string(version / 100 % 100));
  engine.ask = timed(
      [world](const Query& query) { return query.body.radius > 0 ? bench::sweep(*world, query) : ray(*world, query); });
  engine.nearest = timed([world](const Query& query) { return bench::nearest(*world, query); });
  return engine;
}

}  // namespace roam::bench
