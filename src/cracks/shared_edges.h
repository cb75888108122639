#pragma once
/// \file
/// Edges inside a floor: those that two of its triangles share, one on each side.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "roam/survey.h"

namespace roam::cracks {

/// Finds them in phases. The pieces of one phase may be done in any order, by any number of threads; a phase begins
/// when the one before it is done. The answer does not depend on it. Takes 50 bytes a floor while it is at work.
class SharedEdges {
 public:
  /// `survey` must outlive it.
  explicit SharedEdges(const Survey& survey);

  static constexpr int phases = 4;
  [[nodiscard]] std::size_t pieces(int phase) const;
  /// Some milliseconds of work.
  void run(int phase, std::size_t piece);
  /// When all is done, once. Of each of survey.floor_triangles(): bit k is set where the edge from corner k to the next
  /// is also, with the same two corners as numbers, whatever their order, an edge of a floor that lies on its other
  /// side in the plan. Nothing can be told from a bit that is not set: floors may meet without such an edge.
  [[nodiscard]] std::vector<std::uint8_t> take();

 private:
  /// Edges are compared within parts that fit into a core's cache.
  static constexpr std::size_t parts = 512;

  /// Of an edge, told from others by 84 bits of a hash of its corners: looking the corners up again would be most of
  /// the work, for what shares an edge lies anywhere in memory.
  struct Edge {
    std::uint64_t hash;
    std::uint64_t more_hash : 20, side : 2, number : 42;  ///< 3 * floor + corner
    [[nodiscard]] bool is_same(const Edge& other) const { return hash == other.hash && more_hash == other.more_hash; }
  };

  template <class Take>
  void each_edge(std::size_t block, const Take& take) const;
  static std::size_t part_of(const Edge& edge);
  void count(std::size_t block);
  void make_room();
  void mark(std::size_t part);

  const Survey* survey_;
  std::vector<std::array<std::size_t, parts>> at_;  ///< of each block: where its next edge of each part goes
  std::array<std::size_t, parts + 1> begins_{};     ///< of the parts
  std::vector<Edge> edges_;
  std::vector<std::uint8_t> shared_;
};

}  // namespace roam::cracks
