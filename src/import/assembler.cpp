#include "import/assembler.h"

#include <cmath>
#include <limits>
#include <utility>

#include "roam/mesh.h"

namespace roam::reader {
namespace {

using Corners = std::array<std::uint32_t, 3>;
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Corners) == 3 * sizeof(std::uint32_t));

template <class T>
std::vector<T> copied(std::span<const std::byte> payload) {
  if (payload.size() % sizeof(T) != 0) throw Assembler::StreamDamaged{"a frame of broken length"};
  std::vector<T> values(payload.size() / sizeof(T));
  if (!values.empty()) std::memcpy(static_cast<void*>(values.data()), payload.data(), payload.size());
  return values;
}

template <class T>
std::vector<T> joined(std::vector<std::vector<T>>& pieces) {
  if (pieces.size() == 1) {
    std::vector<T> only = std::move(pieces.front());
    pieces.clear();
    return only;
  }
  std::size_t count = 0;
  for (const auto& piece : pieces) count += piece.size();
  std::vector<T> all;
  all.reserve(count);
  for (auto& piece : pieces) {
    all.insert(all.end(), piece.begin(), piece.end());
    std::vector<T>().swap(piece);
  }
  pieces.clear();
  return all;
}

}  // namespace

Assembler::Assembler(ImportedScene& scene, std::size_t ignore_patterns, std::uint64_t mesh_bytes)
    : StreamReceiver(scene.report, ignore_patterns, mesh_bytes), scene_(scene) {}

void Assembler::take_content(FrameKind kind, std::span<const std::byte> payload) {
  if (kind == FrameKind::vertices) return take_vertices(payload);
  if (kind == FrameKind::triangles) return take_triangles(payload);
  if (kind != FrameKind::object) throw StreamDamaged{"a frame of unknown kind"};
  PayloadReader fields(payload);
  finish_mesh();
  in_mesh_ = true;
  name_ = fields.take_text();
  if (fields.take<std::uint8_t>() != 0) throw StreamDamaged{"a piece where a mesh was asked for"};
  if (!fields.complete()) throw StreamDamaged{"a frame of broken length"};
  count_bytes(sizeof(Mesh) + name_.size());
}

void Assembler::finish_content(const Totals& totals) {
  finish_mesh();
  if (totals.vertices != vertices_ || totals.triangles != triangles_) {
    throw StreamDamaged{"totals that are not those of its meshes"};
  }
}

void Assembler::take_vertices(std::span<const std::byte> payload) {
  if (!in_mesh_) throw StreamDamaged{"vertices of no object"};
  count_bytes(payload.size());
  auto vertices = copied<Vec3>(payload);
  for (const Vec3& v : vertices) {
    for (int k = 0; k < 3; ++k) {
      // False for a NaN too.
      if (!(std::abs(v[k]) <= coordinate_limit)) throw StreamDamaged{"a vertex that is not finite"};
    }
  }
  vertices_ += vertices.size();
  mesh_vertices_ += vertices.size();
  if (mesh_vertices_ > std::numeric_limits<std::uint32_t>::max()) throw StreamDamaged{"a mesh of 2^32 vertices"};
  vertex_pieces_.push_back(std::move(vertices));
}

void Assembler::take_triangles(std::span<const std::byte> payload) {
  if (!in_mesh_) throw StreamDamaged{"triangles of no object"};
  count_bytes(payload.size());
  auto triangles = copied<Corners>(payload);
  for (const Corners& corners : triangles) {
    for (const std::uint32_t corner : corners) {
      if (corner >= mesh_vertices_) throw StreamDamaged{"a triangle without its vertices"};
    }
  }
  triangles_ += triangles.size();
  triangle_pieces_.push_back(std::move(triangles));
}

void Assembler::finish_mesh() {
  Mesh mesh;
  mesh.name = std::exchange(name_, {});
  mesh.vertices = joined(vertex_pieces_);
  mesh.triangles = joined(triangle_pieces_);
  mesh_vertices_ = 0;
  in_mesh_ = false;
  if (mesh.triangles.empty()) return;
  scene_.report.vertices += mesh.vertices.size();
  scene_.report.triangles += mesh.triangles.size();
  scene_.meshes.push_back(std::move(mesh));
}

}  // namespace roam::reader
