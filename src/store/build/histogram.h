#pragma once
/// \file
/// How many triangles of a part lie in which cells of the curve.

#include <span>

#include "store/build/run.h"
#include "store/part.h"

namespace roam::store {

/// Depends on the triangles only, not on the runs that they come in. At no time more than some 2^20 cells.
class Histogram {
 public:
  /// Items ascending by key.
  void add(std::span<const RunItem> items);
  /// Sets the cells of the part: the finest of which there are no more than one for 2048 triangles, but 256, and 2^18.
  void finish(PartFile& part);

 private:
  void coarsen(std::size_t most);

  int bits_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace roam::store
