#include "import/piece_receiver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "roam/mesh.h"

namespace roam::reader {
namespace {

using Corners = std::array<std::uint32_t, 3>;
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Corners) == 3 * sizeof(std::uint32_t));

/// Appends the values of a payload, up to `limit` values in all. Returns the index of the first new one.
template <class T>
std::size_t append(std::span<const std::byte> payload, std::size_t limit, std::vector<T>& values) {
  const std::size_t before = values.size();
  const std::size_t count = payload.size() / sizeof(T);
  if (payload.size() % sizeof(T) != 0) throw StreamReceiver::StreamDamaged{"a frame of broken length"};
  if (count > limit - before) throw StreamReceiver::StreamDamaged{"a piece that is too large"};
  values.resize(before + count);
  if (count > 0) std::memcpy(static_cast<void*>(values.data() + before), payload.data(), payload.size());
  return before;
}

}  // namespace

PieceReceiver::PieceReceiver(ImportReport& report, std::size_t ignore_patterns, const PieceSink& sink)
    : StreamReceiver(report, ignore_patterns, std::numeric_limits<std::uint64_t>::max()), sink_(sink) {}

void PieceReceiver::take_content(FrameKind kind, std::span<const std::byte> payload) {
  if (kind == FrameKind::vertices) return take_vertices(payload);
  if (kind == FrameKind::triangles) return take_triangles(payload);
  if (kind != FrameKind::object) throw StreamDamaged{"a frame of unknown kind"};
  begin_piece(payload);
}

void PieceReceiver::begin_piece(std::span<const std::byte> payload) {
  finish_piece();
  PayloadReader fields(payload);
  std::string name = fields.take_text();
  const auto continues = fields.take<std::uint8_t>();
  if (!fields.complete() || continues > 1) throw StreamDamaged{"a frame of broken length"};
  if (continues != 0 && (triangles_ == 0 || name != piece_.name)) throw StreamDamaged{"a piece of no object"};
  continues_ = continues != 0;
  piece_.name = std::move(name);
  in_piece_ = true;
}

void PieceReceiver::take_vertices(std::span<const std::byte> payload) {
  if (!in_piece_) throw StreamDamaged{"vertices of no object"};
  const std::size_t first = append(payload, 3 * piece_triangles, piece_.vertices);
  const std::span fresh = std::span(piece_.vertices).subspan(first);
  vertices_ += fresh.size();
  // False for a NaN too.
  const bool good = std::all_of(fresh.begin(), fresh.end(), [](const Vec3& v) {
    return (std::abs(v.x) <= coordinate_limit) & (std::abs(v.y) <= coordinate_limit) &
           (std::abs(v.z) <= coordinate_limit);
  });
  if (!good) throw StreamDamaged{"a vertex that is not finite"};
}

void PieceReceiver::take_triangles(std::span<const std::byte> payload) {
  if (!in_piece_) throw StreamDamaged{"triangles of no object"};
  const std::size_t first = append(payload, piece_triangles, piece_.triangles);
  const std::span fresh = std::span(piece_.triangles).subspan(first);
  triangles_ += fresh.size();
  std::uint32_t largest = 0;
  for (const Corners& corners : fresh) largest = std::max({largest, corners[0], corners[1], corners[2]});
  if (!fresh.empty() && largest >= piece_.vertices.size()) throw StreamDamaged{"a triangle without its vertices"};
}

void PieceReceiver::finish_content(const Totals& totals) {
  finish_piece();
  if (totals.vertices != vertices_ || totals.triangles != triangles_) {
    throw StreamDamaged{"totals that are not those of its meshes"};
  }
}

void PieceReceiver::finish_piece() {
  if (!in_piece_) return;
  in_piece_ = false;
  if (piece_.triangles.empty()) throw StreamDamaged{"a piece without triangles"};
  report_.vertices += piece_.vertices.size();
  report_.triangles += piece_.triangles.size();
  sink_(piece_, continues_);
  piece_.vertices.clear();
  piece_.triangles.clear();
}

}  // namespace roam::reader
