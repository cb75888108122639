#pragma once
/// \file
/// Edges inside a floor: two of its triangles share each of them, one on each side.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "roam/survey.h"

namespace roam::cracks {

/// Finds these edges in phases. The pieces of one phase may run in any order, on any number of threads; a phase begins
/// when the one before it is done. The result does not depend on the order. Takes 50 bytes a floor while it runs.
class SharedEdges {
 public:
  /// `survey` must outlive it.
  explicit SharedEdges(const Survey& survey);

  static constexpr int phases = 4;
  [[nodiscard]] std::size_t pieces(int phase) const;
  /// Some milliseconds of work.
  void run(int phase, std::size_t piece);
  /// Call it once, after all phases. Returns a byte for each of survey.floor_triangles(). Bit k is set if another floor
  /// shares the edge from corner k to the next, with equal corners in any order, and lies on its other side in the
  /// plan. A bit that is not set says nothing: floors may meet without such an edge.
  [[nodiscard]] std::vector<std::uint8_t> take();

 private:
  /// Edges are compared within parts that fit into a core's cache.
  static constexpr std::size_t parts = 512;

  /// An edge, identified by 84 bits of a hash of its corners. Comparing the corners themselves would be most of the
  /// work, because the triangles of one edge lie anywhere in memory.
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
  std::vector<std::array<std::size_t, parts>> at_;  ///< for each block: the next position for its edges of each part
  std::array<std::size_t, parts + 1> begins_{};     ///< of the parts
  std::vector<Edge> edges_;
  std::vector<std::uint8_t> shared_;
};

}  // namespace roam::cracks
