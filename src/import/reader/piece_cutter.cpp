#include "import/reader/piece_cutter.h"

#include <algorithm>
#include <span>

#include "roam/import.h"

namespace roam::reader {
namespace {

/// Memory of both processes besides vertices: code, the libraries of foreign readers, the window of the file, the
/// current piece on each side, and frames in transit.
constexpr std::uint64_t own_memory = 52u << 20;
/// The tables of vertices take far less than this share of the memory.
constexpr std::uint64_t share_for_tables = 64;

std::uint64_t vertex_memory(std::uint64_t memory_limit) {
  const std::uint64_t taken = own_memory + memory_limit / share_for_tables;
  return memory_limit - std::min(memory_limit, taken);
}

constexpr std::size_t vertices_per_frame = 1u << 16;
static_assert(vertices_per_frame * sizeof(Vec3) <= payload_limit);

}  // namespace

PieceCutter::PieceCutter(FrameWriter& frames, std::uint64_t memory_limit)
    : frames_(frames), vertices_(vertex_memory(memory_limit)), entries_(1u << entry_bits) {
  static_assert(piece_limit == roam::piece_triangles);
  static_assert(piece_limit * 3 * sizeof(std::uint32_t) <= payload_limit);
  static_assert(2 * 3 * piece_limit <= 1u << entry_bits);
}

void PieceCutter::begin_object(std::string_view name) {
  name_ = name;
  continues_ = false;
}

void PieceCutter::finish_object() {
  if (!piece_triangles_.empty()) send();
}

void PieceCutter::send() {
  frames_.send(FrameKind::object, PayloadWriter().add_text(name_).add(static_cast<std::uint8_t>(continues_)));
  continues_ = true;
  const std::span all(piece_vertices_);
  for (std::size_t begin = 0; begin < all.size(); begin += vertices_per_frame) {
    const auto some = all.subspan(begin, std::min(vertices_per_frame, all.size() - begin));
    frames_.send(FrameKind::vertices, std::as_bytes(some));
  }
  frames_.send(FrameKind::triangles, std::as_bytes(std::span(piece_triangles_)));
  vertices_sent_ += piece_vertices_.size();
  triangles_sent_ += piece_triangles_.size();
  for (const std::uint32_t entry : piece_entries_) entries_[entry].in_piece = none;
  piece_entries_.clear();
  piece_vertices_.clear();
  piece_triangles_.clear();
}

}  // namespace roam::reader
