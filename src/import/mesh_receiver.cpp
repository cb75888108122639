#include "import/mesh_receiver.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "roam/mesh.h"

namespace roam::reader {
namespace {

template <class T>
std::size_t count_in(std::span<const std::byte> payload) {
  if (payload.size() % sizeof(T) != 0) throw StreamReceiver::StreamDamaged{"a frame of broken length"};
  return payload.size() / sizeof(T);
}

template <class T>
void copy(std::span<const std::byte> payload, std::span<T> to) {
  if (!payload.empty()) std::memcpy(static_cast<void*>(to.data()), payload.data(), payload.size());
}

}  // namespace

void MeshReceiver::take_content(FrameKind kind, std::span<const std::byte> payload) {
  if (kind == FrameKind::vertices) return take_vertices(payload);
  if (kind == FrameKind::triangles) return take_triangles(payload);
  if (kind != FrameKind::object) throw StreamDamaged{"a frame of unknown kind"};
  begin_object(payload);
}

void MeshReceiver::begin_object(std::span<const std::byte> payload) {
  finish_object();
  PayloadReader fields(payload);
  std::string name = take_object_name(fields);
  const auto continues = fields.take<std::uint8_t>();
  if (!fields.complete() || continues > 1) throw StreamDamaged{"a frame of broken length"};
  count_bytes(sizeof(Mesh) + name.size());
  begin(std::move(name), continues != 0);
  in_object_ = true;
  object_vertices_ = 0;
}

void MeshReceiver::take_vertices(std::span<const std::byte> payload) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  if (!in_object_) throw StreamDamaged{"vertices of no object"};
  count_bytes(payload.size());
  const std::span<Vec3> fresh = more_vertices(count_in<Vec3>(payload));
  copy(payload, fresh);
  vertices_ += fresh.size();
  object_vertices_ += fresh.size();
  if (object_vertices_ > std::numeric_limits<std::uint32_t>::max()) throw StreamDamaged{"a mesh of 2^32 vertices"};
  // False for a NaN too.
  const bool good = std::all_of(fresh.begin(), fresh.end(), [](const Vec3& v) {
    return (std::abs(v.x) <= coordinate_limit) & (std::abs(v.y) <= coordinate_limit) &
           (std::abs(v.z) <= coordinate_limit);
  });
  if (!good) throw StreamDamaged{"a vertex that is not finite"};
}

void MeshReceiver::take_triangles(std::span<const std::byte> payload) {
  static_assert(sizeof(Corners) == 3 * sizeof(std::uint32_t));
  if (!in_object_) throw StreamDamaged{"triangles of no object"};
  count_bytes(payload.size());
  const std::span<Corners> fresh = more_triangles(count_in<Corners>(payload));
  copy(payload, fresh);
  triangles_ += fresh.size();
  std::uint32_t largest = 0;
  for (const Corners& corners : fresh) largest = std::max({largest, corners[0], corners[1], corners[2]});
  if (!fresh.empty() && largest >= object_vertices_) throw StreamDamaged{"a triangle without its vertices"};
}

void MeshReceiver::finish_object() {
  if (std::exchange(in_object_, false)) finish();
}

void MeshReceiver::finish_content(const Totals& totals) {
  finish_object();
  if (totals.vertices != vertices_ || totals.triangles != triangles_) {
    throw StreamDamaged{"totals that are not those of its meshes"};
  }
}

}  // namespace roam::reader
