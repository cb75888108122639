#pragma once
/// \file
/// Division of objects into pieces, so that neither end of the stream needs to hold a whole object.

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "import/reader/frame_writer.h"
#include "import/reader/paged_vertices.h"
#include "roam/math.h"

namespace roam::reader {

/// Where the search for a vertex begins in a table of 2^bits entries. Groups of consecutive vertices have neighbouring
/// entries, a line of the processor's cache, because most triangles use neighbouring vertices. The groups are spread
/// evenly (the finalizer of MurmurHash3), so that no row of vertices meets another.
[[nodiscard]] inline std::uint32_t first_entry(std::uint32_t vertex, unsigned bits) {
  constexpr unsigned group_bits = 3;
  std::uint32_t group = vertex >> group_bits;
  group = (group ^ group >> 16) * 0x85ebca6bu;
  group = (group ^ group >> 13) * 0xc2b2ae35u;
  group ^= group >> 16;
  return (group << group_bits | (vertex & ((1u << group_bits) - 1))) & ((1u << bits) - 1);
}

/// Gathers triangles with vertex numbers of the object into pieces with vertices of their own. Sends each full piece.
/// The division depends only on the triangles.
class PieceCutter {
 public:
  /// `memory_limit`: bytes that this process and the receiver may use together.
  PieceCutter(FrameWriter& frames, std::uint64_t memory_limit);

  /// The vertices of the file, for readers that do not know the last use of a vertex.
  [[nodiscard]] PagedVertices& vertices() { return vertices_; }

  void begin_object(std::string_view name);
  /// Adds a triangle of the current object. vertex_of(k) returns the position of corner k; called only for vertices
  /// that are new in the piece.
  template <class VertexOf>
  void add_triangle(const std::array<std::uint32_t, 3>& corners, VertexOf&& vertex_of) {
    std::array<std::uint32_t, 3> in_piece;
    for (std::size_t k = 0; k < 3; ++k) {
      Entry& entry = entry_of(corners[k]);
      if (entry.in_piece == none) {
        entry = {corners[k], static_cast<std::uint32_t>(piece_vertices_.size())};
        piece_entries_.push_back(static_cast<std::uint32_t>(&entry - entries_.data()));
        piece_vertices_.push_back(vertex_of(k));
      }
      in_piece[k] = entry.in_piece;
    }
    piece_triangles_.push_back(in_piece);
    if (piece_triangles_.size() == piece_limit) send();
  }
  /// Sends the rest of the current object.
  void finish_object();

  [[nodiscard]] std::uint64_t vertices_sent() const { return vertices_sent_; }
  [[nodiscard]] std::uint64_t triangles_sent() const { return triangles_sent_; }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t piece_limit = 1u << 16;
  /// More than twice the vertices of a piece.
  static constexpr unsigned entry_bits = 19;

  /// A vertex of the object and its number in the piece.
  struct Entry {
    std::uint32_t vertex = 0;
    std::uint32_t in_piece = none;
  };

  /// The entry of a vertex, or the free entry for it.
  Entry& entry_of(std::uint32_t vertex) {
    constexpr std::uint32_t mask = (1u << entry_bits) - 1;
    std::uint32_t at = first_entry(vertex, entry_bits);
    while (entries_[at].in_piece != none && entries_[at].vertex != vertex) at = (at + 1) & mask;
    return entries_[at];
  }
  void send();

  FrameWriter& frames_;
  PagedVertices vertices_;
  std::uint64_t vertices_sent_ = 0, triangles_sent_ = 0;
  std::string name_;
  bool continues_ = false;  ///< true: a piece of the object has been sent
  std::vector<Vec3> piece_vertices_;
  std::vector<std::uint32_t> piece_entries_;  ///< the entry of each of piece_vertices_
  std::vector<std::array<std::uint32_t, 3>> piece_triangles_;
  std::vector<Entry> entries_;
};

}  // namespace roam::reader
